//! The example pages of the npm package: served beside it and what they draw with, and tried in a browser.

use std::path::PathBuf;

use crate::failure::Result;
use crate::serve::{Mount, Server};
use crate::{browser, files, js, npm, picture, setup};

/// The three.js that the briefs of the example pages name, and the newest one; both by the folder that npm has them in.
const THREE: [&str; 2] = ["three-160", "three"];

/// The pages, and the package, three.js and Babylon.js beside them.
fn mounts(three: &str) -> Vec<Mount> {
    vec![
        Mount { at: "/muslin/", dir: js::dir() },
        Mount { at: "/vendor/", dir: npm::modules().join(three).join("build") },
        Mount { at: "/babylonjs/", dir: npm::modules().join("babylonjs") },
        Mount { at: "/", dir: files::root().join("bindings/js/examples") },
    ]
}

fn prepare() -> Result {
    setup::ensure(&[&setup::NODE])?;
    js::build()?;
    npm::install()
}

/// Serves the pages until it is stopped.
pub fn serve() -> Result {
    prepare()?;
    let usual = Server::open(mounts(THREE[0]), 8080);
    let server = usual.or_else(|_| Server::open(mounts(THREE[0]), 0))?;
    println!("serving {} (Ctrl-C stops)", server.url());
    server.run();
    Ok(())
}

/// Plays with every page in a browser, with either three.js, and looks at its pictures.
pub fn test() -> Result {
    prepare()?;
    let shots = files::target().join("shots/examples");
    files::make_empty(&shots)?;
    let older = Server::open(mounts(THREE[0]), 0)?.run_aside();
    let newest = PathBuf::from(Server::open(mounts(THREE[1]), 0)?.run_aside());
    let paths = [("MUSLIN_SHOTS", &shots), ("MUSLIN_NEWEST", &newest)];
    browser::node_test("tests/web/examples.test.mjs", &older, &paths)?;
    files::ending(&shots, ".png")?.iter().try_for_each(|shot| picture::check(shot))
}
