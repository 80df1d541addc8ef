//! Packs the npm package as users install it, and tests the file from a page, in node, and in
//! bundlers, frameworks and other runtimes.

use std::path::PathBuf;

use crate::failure::{During, Failure, Result};
use crate::serve::{Mount, Server};
use crate::{browser, files, js, npm, setup, shell};

/// The file that npm packs and installs.
pub fn tarball() -> PathBuf {
    files::root().join("dist").join(format!("muslin-{}.tgz", env!("CARGO_PKG_VERSION")))
}

/// Builds the package, packs it, and prints the sizes of its parts and the time of a tick.
pub fn pack() -> Result {
    write_tarball(&[])
}

/// Builds the package and packs it once in a run of the tests; prints the sizes of its parts, with less
/// compression and few timed ticks.
pub fn pack_for_tests() -> Result {
    files::once_in_run("npm-tarball", || write_tarball(&["--test"]))
}

fn write_tarball(options: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE])?;
    js::build()?;
    let tarball = tarball();
    std::fs::remove_file(&tarball).ok(); // it may be missing
    let mut pack = shell::command("npm");
    let to = tarball.parent().unwrap_or(&tarball);
    pack.current_dir(js::dir())
        .args(["pack", "--silent", "--ignore-scripts", "--pack-destination"])
        .arg(to);
    println!("$ npm pack");
    shell::output(&mut pack)?;
    if !tarball.is_file() {
        return Err(Failure::new(format!("npm pack did not write {}", tarball.display())));
    }
    let mut sizes = shell::command("node");
    shell::run(sizes.arg(files::root().join("benches/node/sizes.mjs")).arg(&tarball).args(options))
}

/// Installs the packed file into projects of several kinds, and opens their pages.
pub fn test() -> Result {
    pack_for_tests()?;
    js::install_for_tests()?;
    let work = files::target().join("clients");
    files::create_empty_dir(&work)?;
    let mounts = || {
        vec![
            Mount { at: "/vendor/", dir: npm::modules().join("three-160/build") },
            Mount { at: "/", dir: work.clone() },
        ]
    };
    let url = Server::open(mounts(), 0)?.spawn();
    let strict = Server::open(mounts(), 0)?.with_policy("script-src 'self'").spawn().into();
    let paths =
        [("MUSLIN_WORK", &work), ("MUSLIN_TARBALL", &tarball()), ("MUSLIN_STRICT", &strict)];
    browser::node_test("tests/web/clients.test.mjs", &url, &paths)
}

/// Installs the packed file beside the frameworks, bundlers and runtimes that the lock file of
/// `tests/frameworks` lists, builds an app in each, and plays the script there.
pub fn test_frameworks() -> Result {
    pack_for_tests()?;
    let sources = files::root().join("tests/frameworks");
    let work = files::target().join("frameworks");
    files::create_dir(&work)?;
    for path in files::list(&sources)? {
        let name = path.file_name().unwrap_or_default();
        let copy = work.join(name);
        if path.is_file() {
            std::fs::copy(&path, &copy).during(|| format!("copying {}", path.display()))?;
        } else if name != "node_modules" {
            files::create_empty_dir(&copy)?;
            files::copy_dir(&path, &copy)?;
        }
    }
    let script = work.join("script.mjs");
    std::fs::copy(files::root().join("tests/js/script.mjs"), script).during(|| "copying".into())?;
    npm::install_in(&work)?;
    let installed = work.join("node_modules/muslin");
    if installed.exists() {
        std::fs::remove_dir_all(&installed).during(|| "removing the last package".into())?;
    }
    let mut install = shell::command("npm");
    install.current_dir(&work).args(["install", "--no-save", "--offline", "--ignore-scripts"]);
    shell::run(install.args(["--no-audit", "--no-fund"]).arg(tarball()))?;
    // The oldest Node, which is one of the packages, must not be what programs start as `node`.
    std::fs::remove_file(work.join("node_modules/.bin/node")).ok(); // other platforms lack it
    let url = Server::open(vec![Mount { at: "/", dir: work.clone() }], 0)?.spawn();
    browser::node_test("tests/web/frameworks.test.mjs", &url, &[("MUSLIN_WORK", &work)])
}
