//! Packs folders into archives, with the same bytes wherever and whenever that is done.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, SystemTime};

use crate::failure::{During, Failure, Result};
use crate::pack::Package;
use crate::{files, shell};

/// The time of all files in archives, in seconds since 1970: `SOURCE_DATE_EPOCH` if that is set,
/// else that of the last commit.
pub fn time() -> Result<u64> {
    // A commit while packages are built leaves the time as it is.
    static TIME: OnceLock<u64> = OnceLock::new();
    if let Some(time) = TIME.get() {
        return Ok(*time);
    }
    let text = match std::env::var("SOURCE_DATE_EPOCH") {
        Ok(text) => text,
        Err(_) => shell::output(shell::command("git").args(["log", "-1", "--format=%ct"]))
            .during(|| "asking git for a time, since SOURCE_DATE_EPOCH is not set".into())?,
    };
    let invalid = || Failure::new("`SOURCE_DATE_EPOCH` must be a number of seconds");
    let time = text.trim().parse().map_err(|_| invalid())?;
    Ok(*TIME.get_or_init(|| time))
}

/// Packs the folder of a package, under its own name, into `archive`: a zip file, or a tar file
/// that is compressed by gzip.
pub fn write(package: &Package, archive: &Path) -> Result {
    let parent = package.dir.parent().unwrap_or(&package.dir);
    let folder = package.dir.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if archive.exists() {
        std::fs::remove_file(archive).during(|| format!("removing {}", archive.display()))?;
    }
    if archive.extension().is_none_or(|extension| extension != "zip") {
        let mut tar = shell::command("tar");
        tar.arg("--directory").arg(parent).args(["--sort=name", "--format=gnu"]);
        tar.args(["--owner=0", "--group=0", "--numeric-owner", "--mode=u=rwX,go=rX"]);
        tar.arg(format!("--mtime=@{}", time()?)).args(["--use-compress-program", "gzip -9n"]);
        return shell::run(tar.args(["--create", "--file"]).arg(archive).arg(folder));
    }
    let modified = SystemTime::UNIX_EPOCH + Duration::from_secs(time()?);
    for name in package.entries()? {
        std::fs::File::options()
            .write(true)
            .open(package.dir.join(&name))
            .and_then(|file| file.set_modified(modified))
            .during(|| format!("setting the time of {name}"))?;
    }
    let names = package.entries()?.into_iter().map(|name| format!("{folder}/{name}"));
    let mut zip = shell::command("zip");
    zip.current_dir(parent).env("TZ", "UTC").args(["-9", "-X", "--quiet"]).arg(archive);
    shell::run(zip.args(names))
}

/// Unpacks an archive into a folder.
pub fn unpack(archive: &Path, into: &Path) -> Result {
    let mut command = if archive.extension().is_some_and(|extension| extension == "zip") {
        let mut unzip = shell::command("unzip");
        unzip.args(["-q", "-o"]).arg(archive).arg("-d");
        unzip
    } else {
        let mut tar = shell::command("tar");
        tar.args(["--extract", "--file"]).arg(archive).arg("--directory");
        tar
    };
    shell::run(command.arg(into))
}

/// The folder of archives and their checksums.
pub fn dir() -> PathBuf {
    files::root().join("dist/release")
}
