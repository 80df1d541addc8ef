//! C and C++ sources that tests build. They come inside crates of fixed versions, which cargo
//! downloads.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::{files, shell};

/// A crate that holds C or C++ sources.
pub struct Source {
    name: &'static str,
    version: &'static str,
    /// The folder of the sources in the crate.
    folder: &'static str,
}

/// The fuzzer of LLVM.
pub const LIBFUZZER: Source =
    Source { name: "libfuzzer-sys", version: "0.4.13", folder: "libfuzzer" };

/// The game library raylib.
pub const RAYLIB: Source = Source { name: "raylib-sys", version: "6.0.0", folder: "raylib/src" };

impl Source {
    /// Downloads the crate unless it is there, and returns the folder of the sources.
    pub fn fetch(&self) -> Result<PathBuf> {
        let Self { name, version, folder } = self;
        let package_dir = files::target().join("sources").join(name);
        files::create_dir(&package_dir)?;
        let manifest = package_dir.join("Cargo.toml");
        let package = "[package]\nname = \"sources\"\nedition = \"2021\"\n[workspace]\n\
                       [lib]\npath = \"lib.rs\"\n";
        let dependency =
            format!("{name} = {{ version = \"={version}\", default-features = false }}");
        files::write(&manifest, &format!("{package}[dependencies]\n{dependency}\n"))?;
        files::write(&package_dir.join("lib.rs"), "")?;
        let mut cargo = shell::cargo(&["metadata", "--format-version=1", "--manifest-path"]);
        let metadata = shell::output(cargo.arg(&manifest))?;
        let end = format!("{name}-{version}/Cargo.toml");
        let paths = metadata
            .split("\"manifest_path\":\"")
            .skip(1)
            .filter_map(|rest| rest.split('"').next());
        let found = paths.map(PathBuf::from).find(|path| path.ends_with(&end));
        let sources = found.and_then(|path| path.parent().map(|root| root.join(folder)));
        sources.ok_or_else(|| Failure::new(format!("cargo did not download {name} {version}")))
    }
}
