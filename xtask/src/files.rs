//! Folders of this repository, and operations on files in them. Errors name the path.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};

/// The root of the repository.
pub fn root() -> PathBuf {
    let xtask = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    xtask.parent().map_or_else(|| PathBuf::from("."), Path::to_path_buf)
}

/// The folder that cargo builds in.
pub fn target() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(dir) => root().join(dir),
        None => root().join("target"),
    }
}

/// Creates a folder and its parents; does nothing where it exists.
pub fn create_dir(dir: &Path) -> Result {
    fs::create_dir_all(dir).during(|| format!("creating {}", dir.display()))
}

/// Creates an empty folder, and removes the one that was there.
pub fn create_empty_dir(dir: &Path) -> Result {
    if dir.symlink_metadata().is_ok() {
        fs::remove_dir_all(dir).during(|| format!("removing {}", dir.display()))?;
    }
    create_dir(dir)
}

/// Copies the content of a folder into another one, folders in it included.
pub fn copy_dir(from: &Path, to: &Path) -> Result {
    create_dir(to)?;
    for path in list(from)? {
        let copy = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_dir(&path, &copy)?;
        } else {
            fs::copy(&path, &copy).during(|| format!("copying {}", path.display()))?;
        }
    }
    Ok(())
}

/// Makes `at` a symbolic link to `target`, which lies beside it; replaces a file that was there.
pub fn symlink(target: &str, at: &Path) -> Result {
    let during = || format!("linking {}", at.display());
    if at.symlink_metadata().is_ok() {
        fs::remove_file(at).during(during)?;
    }
    #[cfg(unix)]
    let done = std::os::unix::fs::symlink(target, at);
    #[cfg(not(unix))]
    let done = at.parent().map_or(Ok(0), |dir| fs::copy(dir.join(target), at)).map(|_| ());
    done.during(during)
}

/// The paths in a folder, sorted by name.
pub fn list(dir: &Path) -> Result<Vec<PathBuf>> {
    let during = || format!("reading {}", dir.display());
    let entries = fs::read_dir(dir).during(during)?;
    let mut paths = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<std::io::Result<Vec<_>>>()
        .during(during)?;
    paths.sort();
    Ok(paths)
}

/// The files of a folder whose names end in `suffix`, sorted by name.
///
/// # Errors
/// Fails if there is none.
pub fn with_suffix(dir: &Path, suffix: &str) -> Result<Vec<PathBuf>> {
    let matches = |path: &PathBuf| {
        path.file_name().and_then(OsStr::to_str).is_some_and(|name| name.ends_with(suffix))
    };
    let found: Vec<_> = list(dir)?.into_iter().filter(matches).collect();
    if found.is_empty() {
        return Err(Failure::new(format!("there is no *{suffix} in {}", dir.display())));
    }
    Ok(found)
}

/// Writes a text file.
pub fn write(path: &Path, text: &str) -> Result {
    fs::write(path, text).during(|| format!("writing {}", path.display()))
}

/// Reads a text file.
pub fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).during(|| format!("reading {}", path.display()))
}

/// The environment variable that names a run of several steps of the tests.
pub const RUN: &str = "MUSLIN_RUN";

/// Calls `build`, unless another step of the same run of the tests has built the same.
///
/// Steps that run side by side wait for each other here.
pub fn once_in_run(name: &str, build: impl FnOnce() -> Result) -> Result {
    let Ok(run) = std::env::var(RUN) else { return build() };
    let _lock = lock(name)?;
    let stamp = target().join(format!("{name}.run"));
    if read(&stamp).is_ok_and(|last| last == run) {
        println!("{name}: built by an earlier step");
        return Ok(());
    }
    fs::remove_file(&stamp).ok(); // it may be missing
    build()?;
    write(&stamp, &run)
}

/// Waits until no other process of xtask holds the lock `name`, and holds it until the file is
/// dropped.
///
/// Steps that run side by side install things one after the other this way.
pub fn lock(name: &str) -> Result<fs::File> {
    let during = || format!("waiting for the lock {name}");
    create_dir(&target())?;
    let file = fs::File::create(target().join(format!("{name}.lock"))).during(during)?;
    file.lock().during(during)?;
    Ok(file)
}
