//! The npm packages that tests use: locked in `tests/package-lock.json`.

use std::path::PathBuf;

use crate::failure::Result;
use crate::{files, js, setup, shell};

/// Where they are.
pub fn modules() -> PathBuf {
    files::root().join("tests/node_modules")
}

/// Installs what the lock says unless it is there, and the package `muslin` as it was last built.
pub fn install() -> Result {
    setup::ensure(&[&setup::NODE])?;
    let tests = files::root().join("tests");
    let lock = files::read(&tests.join("package-lock.json"))?;
    let installed = modules().join(".installed-lock.json");
    if files::read(&installed).ok().as_ref() != Some(&lock) {
        let mut npm = shell::command("npm");
        npm.current_dir(&tests);
        shell::run(npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))?;
        files::write(&installed, &lock)?;
    }
    if js::dir().is_dir() {
        // A copy, as an installation is: from here it finds the packages that it asks for.
        let muslin = modules().join("muslin");
        files::make_empty(&muslin)?;
        files::copy_all(&js::dir(), &muslin)?;
    }
    Ok(())
}
