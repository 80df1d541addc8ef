//! The demo as a page: built into `dist/web`, and tried in a browser.

use std::path::PathBuf;

use crate::browser::Served;
use crate::failure::Result;
use crate::{browser, files, picture, wasm};

/// Where the page is built.
pub fn dir() -> PathBuf {
    files::root().join("dist/web")
}

/// Builds the page.
pub fn build() -> Result {
    files::make_empty(&dir())?;
    files::copy_all(&files::root().join("demo/web"), &dir())?;
    // The receipt's font is in the wasm; its licence goes with it.
    let licence = files::read(&files::root().join("demo/fonts/OFL.txt"))?;
    files::write(&dir().join("OFL.txt"), &licence)?;
    wasm::build("muslin-demo", &dir(), "muslin_demo")?;
    println!("the page is in dist/web; it needs a server, such as `cargo xtask demo --web`");
    Ok(())
}

/// Serves the page as a person would and plays with it in a browser.
pub fn test() -> Result {
    let served = Served::by(&["demo", "--web", "--no-open", "--port", "0"])?;
    let shots = files::target().join("shots");
    files::make(&shots)?;
    let pictures =
        ["web-1280x720.png", "web-390x844.png", "tender-1280x720.png", "tender-390x844.png"];
    let pictures = pictures.map(|name| shots.join(name));
    for stale in pictures.iter().filter(|picture| picture.exists()) {
        std::fs::remove_file(stale).ok();
    }
    browser::node_test("tests/web/demo.test.mjs", &served.url, &[("MUSLIN_SHOTS", &shots)])?;
    pictures.iter().try_for_each(|picture| picture::check(picture))
}
