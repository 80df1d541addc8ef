//! C and C++ that crates bring along, for tests to build: cargo fetches them, of one version each.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::{files, shell};

/// A crate with sources of another language in it.
pub struct Source {
    name: &'static str,
    version: &'static str,
    /// Where in it they are.
    within: &'static str,
}

/// The engine that fuzzes.
pub const LIBFUZZER: Source =
    Source { name: "libfuzzer-sys", version: "0.4.13", within: "libfuzzer" };

/// The game library.
pub const RAYLIB: Source = Source { name: "raylib-sys", version: "6.0.0", within: "raylib/src" };

impl Source {
    /// The folder of the sources, fetched if they are not there yet.
    pub fn fetch(&self) -> Result<PathBuf> {
        let Self { name, version, within } = self;
        let asks = files::target().join("sources").join(name);
        files::make(&asks)?;
        let manifest = asks.join("Cargo.toml");
        let package = "[package]\nname = \"sources\"\nedition = \"2021\"\n[workspace]\n[lib]\npath = \"lib.rs\"\n";
        let wish = format!("{name} = {{ version = \"={version}\", default-features = false }}");
        files::write(&manifest, &format!("{package}[dependencies]\n{wish}\n"))?;
        files::write(&asks.join("lib.rs"), "")?;
        let mut cargo = shell::cargo(&["metadata", "--format-version=1", "--manifest-path"]);
        let told = shell::output(cargo.arg(&manifest))?;
        let end = format!("{name}-{version}/Cargo.toml");
        let paths =
            told.split("\"manifest_path\":\"").skip(1).filter_map(|rest| rest.split('"').next());
        let found = paths.map(PathBuf::from).find(|path| path.ends_with(&end));
        let folder = found.and_then(|path| path.parent().map(|root| root.join(within)));
        folder.ok_or_else(|| Failure::new(format!("cargo fetched no {name} {version}")))
    }
}
