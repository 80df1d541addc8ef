//! Packs the npm package as users install it, and tests the file from a page, with Vite, with
//! webpack and in node.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::serve::{Mount, Server};
use crate::{browser, files, js, npm, setup, shell};

/// The file that npm packs and installs.
pub fn tarball() -> PathBuf {
    files::root().join("dist").join(format!("muslin-{}.tgz", env!("CARGO_PKG_VERSION")))
}

/// Builds the package, packs it, and prints the sizes of its parts.
pub fn pack() -> Result {
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
    shell::run(sizes.arg(files::root().join("benches/node/sizes.mjs")).arg(&tarball))
}

/// Installs the packed file into projects of several kinds, and opens their pages.
pub fn test() -> Result {
    pack()?;
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
