//! Installs npm packages as lock files say.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::{files, setup, shell};

/// The folder of the npm packages that tests use.
pub fn modules() -> PathBuf {
    files::root().join("tests/node_modules")
}

/// Installs the npm packages that tests use, which `tests/package-lock.json` lists.
pub fn install() -> Result {
    install_in(&files::root().join("tests"))
}

/// Installs the packages that the lock file of a folder lists, unless just these are installed.
pub fn install_in(dir: &Path) -> Result {
    setup::ensure(&[&setup::NODE])?;
    let _lock = files::lock("npm")?;
    let packages = files::read(&dir.join("package-lock.json"))?;
    let installed = dir.join("node_modules/.installed-lock.json");
    if files::read(&installed).ok().as_ref() != Some(&packages) {
        let mut npm = shell::command("npm");
        npm.current_dir(dir);
        shell::run(npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))?;
        files::write(&installed, &packages)?;
    }
    Ok(())
}
