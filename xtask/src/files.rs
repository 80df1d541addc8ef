//! Folders of this repository, and what happens to files in them.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};

/// The repository.
pub fn root() -> PathBuf {
    let xtask = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    xtask.parent().map_or_else(|| PathBuf::from("."), Path::to_path_buf)
}

/// Where cargo builds.
pub fn target() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(dir) => root().join(dir),
        None => root().join("target"),
    }
}

/// Makes a folder, and those above it.
pub fn make(dir: &Path) -> Result {
    fs::create_dir_all(dir).during(|| format!("making {}", dir.display()))
}

/// Makes a folder that holds nothing.
pub fn make_empty(dir: &Path) -> Result {
    if dir.symlink_metadata().is_ok() {
        fs::remove_dir_all(dir).during(|| format!("removing {}", dir.display()))?;
    }
    make(dir)
}

/// Copies what is in one folder into another.
pub fn copy_all(from: &Path, to: &Path) -> Result {
    make(to)?;
    for path in list(from)? {
        let copy = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_all(&path, &copy)?;
        } else {
            fs::copy(&path, &copy).during(|| format!("copying {}", path.display()))?;
        }
    }
    Ok(())
}

/// Makes `at` another name for what lies beside it, in place of what it was.
pub fn link(target: &str, at: &Path) -> Result {
    let told = || format!("linking {}", at.display());
    if at.symlink_metadata().is_ok() {
        fs::remove_file(at).during(told)?;
    }
    #[cfg(unix)]
    let done = std::os::unix::fs::symlink(target, at);
    #[cfg(not(unix))]
    let done = at.parent().map_or(Ok(0), |dir| fs::copy(dir.join(target), at)).map(|_| ());
    done.during(told)
}

/// What is in a folder, by name.
pub fn list(dir: &Path) -> Result<Vec<PathBuf>> {
    let told = || format!("reading {}", dir.display());
    let entries = fs::read_dir(dir).during(told)?;
    let mut paths = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<std::io::Result<Vec<_>>>()
        .during(told)?;
    paths.sort();
    Ok(paths)
}

/// The files of a folder whose names end like this; at least one.
pub fn ending(dir: &Path, end: &str) -> Result<Vec<PathBuf>> {
    let named = |path: &PathBuf| {
        path.file_name().and_then(OsStr::to_str).is_some_and(|name| name.ends_with(end))
    };
    let found: Vec<_> = list(dir)?.into_iter().filter(named).collect();
    if found.is_empty() {
        return Err(Failure::new(format!("there is no *{end} in {}", dir.display())));
    }
    Ok(found)
}

/// Writes a file.
pub fn write(path: &Path, text: &str) -> Result {
    fs::write(path, text).during(|| format!("writing {}", path.display()))
}

/// Reads a file.
pub fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).during(|| format!("reading {}", path.display()))
}
