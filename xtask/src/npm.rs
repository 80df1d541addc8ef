//! The npm packages that tests use: locked in `tests/package-lock.json`.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::{files, js, setup, shell};

/// Where they are.
pub fn modules() -> PathBuf {
    files::root().join("tests/node_modules")
}

/// Installs what the lock says unless it is there, and the package `muslin` as it was last built.
pub fn install() -> Result {
    setup::ensure(&[&setup::NODE])?;
    install_in(&files::root().join("tests"))?;
    if js::dir().is_dir() {
        // A copy, as an installation is: from here it finds the packages that it asks for.
        let muslin = modules().join("muslin");
        files::make_empty(&muslin)?;
        files::copy_all(&js::dir(), &muslin)?;
    }
    Ok(())
}

/// Installs what the lock of a folder says, unless it is there.
pub fn install_in(dir: &Path) -> Result {
    let lock = files::read(&dir.join("package-lock.json"))?;
    let installed = dir.join("node_modules/.installed-lock.json");
    if files::read(&installed).ok().as_ref() != Some(&lock) {
        let mut npm = shell::command("npm");
        npm.current_dir(dir);
        shell::run(npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))?;
        files::write(&installed, &lock)?;
    }
    Ok(())
}
