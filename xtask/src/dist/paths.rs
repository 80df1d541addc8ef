//! The folders that release packages are built and tried in, and the environment of their tools.

use std::ffi::OsString;
use std::path::PathBuf;

use crate::failure::{During, Result};
use crate::{files, python, shell};

fn dir() -> PathBuf {
    files::target().join("dist")
}

/// The folder that packages are built in.
pub fn packages_dir() -> PathBuf {
    dir().join("packages")
}

/// The folder of what lies between, and of programs that try the packages.
pub fn work_dir() -> PathBuf {
    dir().join("work")
}

/// The folder that archives are unpacked in, side by side.
pub fn unpacked_dir() -> PathBuf {
    dir().join("unpacked")
}

/// The environment with Zig and the programs of `bindings/c/tools/requirements.txt`.
pub fn tools_dir() -> PathBuf {
    dir().join("tools")
}

/// Makes the environment, unless it is there.
pub fn install_tools() -> Result {
    let requirements = files::root().join("bindings/c/tools/requirements.txt");
    python::install_environment(&tools_dir(), &requirements)
}

/// `PATH` with the programs of the environment in front.
pub fn zig_path() -> Result<OsString> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let dirs = std::iter::once(tools_dir().join("bin")).chain(std::env::split_paths(&path));
    std::env::join_paths(dirs).during(|| "joining PATH".into())
}

/// The path of Zig.
pub fn zig() -> Result<PathBuf> {
    let mut python = python::python_of(&tools_dir());
    let code = "import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), 'zig'))";
    Ok(shell::output(python.args(["-c", code]))?.trim().into())
}
