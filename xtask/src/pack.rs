//! The folder of a package of the C library: headers, libraries, files for pkg-config and CMake,
//! licences and checksums.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Result};
use crate::{files, shell};

/// The version of the library.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
const MAJOR: &str = env!("CARGO_PKG_VERSION_MAJOR");

/// A package that is being filled.
pub struct Package {
    /// Its folder.
    pub dir: PathBuf,
    /// The target as Rust names it.
    pub target: String,
    /// The system libraries that the static library needs: names, or options of the linker.
    pub system_libraries: &'static [&'static str],
    /// Whether it has a shared library.
    pub has_shared: bool,
}

impl Package {
    /// Creates the folder with all but the libraries.
    pub fn create(&self) -> Result {
        files::create_empty_dir(&self.dir)?;
        files::create_dir(&self.lib())?;
        let root = files::root();
        for header in ["muslin.h", "muslin.hpp"] {
            self.copy(&root.join("include").join(header), &format!("include/{header}"))?;
        }
        for license in ["LICENSE-MIT", "LICENSE-APACHE"] {
            self.copy(&root.join(license), &format!("share/doc/muslin/{license}"))?;
        }
        self.copy(&root.join("bindings/c/README.md"), "share/doc/muslin/README.md")?;
        self.fill(&root.join("bindings/c/PACKAGE.md"), "README.md")?;
        self.fill(&root.join("bindings/c/muslin.pc.in"), "lib/pkgconfig/muslin.pc")?;
        for config in ["MuslinConfig.cmake", "MuslinConfigVersion.cmake"] {
            let from = root.join("bindings/c/cmake").join(config);
            self.fill(&from, &format!("lib/cmake/Muslin/{config}"))?;
        }
        Ok(())
    }

    /// The folder of the libraries.
    pub fn lib(&self) -> PathBuf {
        self.dir.join("lib")
    }

    /// Copies a file to a place in the folder.
    pub fn copy(&self, from: &Path, to: &str) -> Result {
        let to = self.dir.join(to);
        files::create_dir(to.parent().unwrap_or(&to))?;
        std::fs::copy(from, &to).map(|_| ()).during(|| format!("copying {}", from.display()))
    }

    /// Copies `libmuslin.so` under its version, without local symbols, with the links to it that
    /// linkers and programs follow.
    pub fn add_shared(&self, library: &Path, strip: &Path) -> Result {
        let whole = shared_name();
        self.copy(library, &format!("lib/{whole}"))?;
        shell::run(shell::command(strip).arg(self.lib().join(&whole)))?;
        let soname = format!("libmuslin.so.{MAJOR}");
        files::symlink(&whole, &self.lib().join(&soname))?;
        files::symlink(&soname, &self.lib().join("libmuslin.so"))
    }

    /// Copies a text with its placeholders, such as `@version@`, filled in.
    fn fill(&self, from: &Path, to: &str) -> Result {
        let to = self.dir.join(to);
        files::create_dir(to.parent().unwrap_or(&to))?;
        let flags: String =
            linker_options(self.system_libraries).map(|word| format!(" {word}")).collect();
        // Who links a static library links what it needs.
        let (public, private) =
            if self.has_shared { ("", flags.as_str()) } else { (flags.as_str(), "") };
        let text = files::read(from)?
            .replace("@version@", VERSION)
            .replace("@major@", MAJOR)
            .replace("@target@", &self.target)
            .replace("@system_libraries@", &self.system_libraries.join(";"))
            .replace("@linker_options@", &flags)
            .replace("@public_libraries@", public)
            .replace("@private_libraries@", private);
        files::write(&to, &text)
    }

    /// Writes the checksum of every file, so that `sha256sum --check SHA256SUMS` finds damaged ones.
    pub fn write_checksums(&self) -> Result {
        write_checksums(&self.dir)
    }

    /// The paths of all files and links from the folder, sorted.
    pub fn entries(&self) -> Result<Vec<String>> {
        let mut names = Vec::new();
        list(&self.dir, "", &mut names)?;
        names.sort();
        Ok(names)
    }
}

/// The options that link these libraries, some of which are options already.
pub fn linker_options(libraries: &[&str]) -> impl Iterator<Item = String> {
    libraries.iter().map(
        |name| {
            if name.starts_with('-') { (*name).into() } else { format!("-l{name}") }
        },
    )
}

/// The name of the shared library on Linux.
pub fn shared_name() -> String {
    format!("libmuslin.so.{VERSION}")
}

/// Writes `SHA256SUMS` with the checksum of every plain file of a folder.
pub fn write_checksums(dir: &Path) -> Result {
    let mut names = Vec::new();
    list(dir, "", &mut names)?;
    names.retain(|name| name != "SHA256SUMS" && !dir.join(name).is_symlink());
    let mut sum = Command::new("sha256sum");
    let sums = shell::output(sum.current_dir(dir).args(&names))?;
    files::write(&dir.join("SHA256SUMS"), &sums)
}

/// Fails if a file differs from its checksum in `SHA256SUMS`.
pub fn check_checksums(dir: &Path) -> Result {
    let mut sums = Command::new("sha256sum");
    shell::run(sums.current_dir(dir).args(["--check", "--quiet", "SHA256SUMS"]))
}

/// Collects the files and links of a folder by their paths from the top, which begin with `prefix`.
fn list(folder: &Path, prefix: &str, names: &mut Vec<String>) -> Result {
    for path in files::list(folder)? {
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() && !path.is_symlink() {
            list(&path, &format!("{name}/"), names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}
