//! Serves the example pages of the npm package and tests them in a browser.

use std::path::PathBuf;

use crate::failure::Result;
use crate::serve::{Mount, Server};
use crate::{browser, files, js, npm, picture, setup};

/// The npm folders of three.js: release 160, and the newest one.
const THREE: [&str; 2] = ["three-160", "three"];

/// The folders that pages load from: the pages themselves, the package, three.js with its loaders, and
/// Babylon.js.
fn mounts(three: &str) -> Vec<Mount> {
    vec![
        Mount { at: "/muslin/", dir: js::dir() },
        Mount { at: "/vendor/", dir: npm::modules().join(three).join("build") },
        Mount { at: "/jsm/", dir: npm::modules().join(three).join("examples/jsm") },
        Mount { at: "/babylonjs/", dir: npm::modules().join("babylonjs") },
        Mount { at: "/", dir: files::root().join("bindings/js/examples") },
    ]
}

fn prepare() -> Result {
    setup::ensure(&[&setup::NODE])?;
    js::build()?;
    js::install_for_tests()
}

/// `cargo xtask examples`: serves the pages until it is stopped.
pub fn serve() -> Result {
    prepare()?;
    let usual = Server::open(mounts(THREE[0]), 8080);
    let server = usual.or_else(|_| Server::open(mounts(THREE[0]), 0))?;
    println!("serving {} (Ctrl-C stops)", server.url());
    server.run();
    Ok(())
}

/// Tests every page in a browser with both releases of three.js, and checks the pictures.
pub fn test() -> Result {
    prepare()?;
    let shots = files::target().join("shots/examples");
    files::create_empty_dir(&shots)?;
    let older = Server::open(mounts(THREE[0]), 0)?.spawn();
    let newest = PathBuf::from(Server::open(mounts(THREE[1]), 0)?.spawn());
    let paths = [("MUSLIN_SHOTS", &shots), ("MUSLIN_NEWEST", &newest)];
    browser::node_test("tests/web/examples.test.mjs", &older, &paths)?;
    files::with_suffix(&shots, ".png")?.iter().try_for_each(|shot| picture::check(shot))
}
