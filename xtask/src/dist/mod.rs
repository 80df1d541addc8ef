//! Release packages of the C library for all platforms: `cargo xtask dist`.
//!
//! ```text
//! platforms ─▶ build: cargo, prelink, checks of symbols ─▶ target/dist/packages/NAME
//!           ─▶ archive ─▶ dist/release/NAME.tar.gz, SHA256SUMS
//!           ─▶ trial: unpacks the archive, builds and runs programs that use it
//! ```

mod archive;
mod build;
mod paths;
mod platforms;
mod trial;

use std::path::PathBuf;

use crate::binutils::Binutils;
use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{files, pack};

use paths::{packages_dir, unpacked_dir, work_dir};
pub use platforms::GLIBC_LIBRARIES;
use platforms::{PLATFORMS, Platform};

/// What building and trying the packages needs.
pub const NEEDS: &[&Need] = &[
    &setup::CXX,
    &setup::CMAKE,
    &setup::PKG_CONFIG,
    &setup::PYTHON_VENV,
    &setup::QEMU,
    &setup::AARCH64_GCC,
    &setup::MINGW,
    &setup::EMSCRIPTEN,
    &setup::NODE,
    &setup::WINE,
    &setup::ZIP,
];

/// A package that was built and tried.
struct Done {
    platform: &'static Platform,
    /// The size of the archive [bytes].
    size: u64,
}

/// `cargo xtask dist [TARGET…]`: the packages of all platforms, or of those that are named.
pub fn run(words: &[String]) -> Result {
    let chosen = chosen(words)?;
    if chosen.len() == PLATFORMS.len() {
        files::create_empty_dir(&archive::dir())?;
    }
    make(&chosen).map(|_| ())
}

/// Step `dist`: makes all packages, and checks that CMake selects the one for each platform.
pub fn test() -> Result {
    run(&[])?;
    trial::check_selection(PLATFORMS)?;
    trial::check_refusal(PLATFORMS)?;
    check_same_bytes()
}

/// The platforms of these targets; all if there are none.
fn chosen(words: &[String]) -> Result<Vec<&'static Platform>> {
    let is_known = |word: &&String| PLATFORMS.iter().any(|one| one.target == **word);
    if let Some(unknown) = words.iter().find(|word| !is_known(word)) {
        let targets: Vec<_> = PLATFORMS.iter().map(|one| one.target).collect();
        let targets = targets.join(", ");
        return Err(Failure::new(format!("no package for {unknown:?}; the targets are {targets}")));
    }
    let is_chosen =
        |one: &&Platform| words.is_empty() || words.iter().any(|word| word == one.target);
    Ok(PLATFORMS.iter().filter(is_chosen).collect())
}

/// Builds, packs and tries the packages of these platforms, and prints the table.
fn make(platforms: &[&'static Platform]) -> Result {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err(Failure::new("release packages are made on x86-64 Linux only"));
    }
    setup::ensure(NEEDS)?;
    paths::install_tools()?;
    let tools = Binutils::llvm()?;
    for dir in [archive::dir(), packages_dir(), work_dir()] {
        files::create_dir(&dir)?;
    }
    files::create_empty_dir(&unpacked_dir())?;
    let mut done = Vec::new();
    for &platform in platforms {
        println!("\n-- {}", platform.target);
        let package = build::package(platform, &tools)?;
        let archive = archive_path(platform);
        archive::write(&package, &archive)?;
        archive::unpack(&archive, &unpacked_dir())?;
        let size = std::fs::metadata(&archive).during(|| "reading an archive".into())?.len();
        done.push(Done { platform, size });
    }
    pack::write_checksums(&archive::dir())?;
    // All are unpacked side by side, so that CMake must select the right one.
    for Done { platform, .. } in &done {
        println!("\n-- {}: {}", platform.target, platform.tried());
        trial::try_out(platform).during(|| platform.target.into())?;
    }
    println!("\n{}", table(&done));
    println!("the packages are in dist/release");
    Ok(())
}

/// A row for each package: its libraries, its size, and how it was tried.
fn table(done: &[Done]) -> String {
    let row = |cells: [&str; 4], tried| {
        let [target, about, libraries, size] = cells;
        format!("{target:26} {about:25} {libraries:29} {size:>8}  {tried}\n")
    };
    let mut text = row(["target", "platform", "libraries", "archive"], "a program with it was");
    for Done { platform, size } in done {
        let size = format!("{:.2} MB", *size as f64 / 1e6);
        let cells = [platform.target, platform.about, platform.libraries(), &size];
        text += &row(cells, platform.tried());
    }
    text
}

/// Fails if packing twice gives other bytes.
fn check_same_bytes() -> Result {
    for platform in PLATFORMS.iter().filter(|one| one.has_shared) {
        let package = pack::Package {
            dir: packages_dir().join(build::name(platform)),
            target: platform.target.into(),
            system_libraries: platform.system_libraries,
            has_shared: true,
        };
        let again = work_dir().join(format!("again{}", platform.archive_suffix()));
        archive::write(&package, &again)?;
        let read = |path: PathBuf| std::fs::read(path).during(|| "reading an archive".into());
        if read(again)? != read(archive_path(platform))? {
            return Err(Failure::new(format!("packing {} twice differs", platform.target)));
        }
    }
    Ok(())
}

/// The archive for a target.
pub fn archive_of(target: &str) -> Result<PathBuf> {
    Ok(archive_path(chosen(&[target.into()])?[0]))
}

fn archive_path(platform: &Platform) -> PathBuf {
    archive::dir().join(build::name(platform) + platform.archive_suffix())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_chosen_by_name_and_an_unknown_one_is_refused() {
        assert_eq!(chosen(&[]).unwrap().len(), PLATFORMS.len());
        let one = chosen(&["aarch64-apple-ios".into()]).unwrap();
        assert_eq!(one.iter().map(|one| one.target).collect::<Vec<_>>(), ["aarch64-apple-ios"]);
        let failure = chosen(&["amiga".into()]).err().unwrap().to_string();
        assert!(
            failure.contains("\"amiga\"") && failure.contains("aarch64-apple-ios"),
            "{failure}"
        );
    }
}
