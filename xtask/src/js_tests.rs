//! The tests of the npm package in node and in a browser.

use std::path::PathBuf;

use crate::failure::Result;
use crate::serve::{Mount, Server};
use crate::{bench, browser, files, js, npm, shell};

/// Test files that take less than a minute without WebAssembly too. There `builds.test.mjs` plays
/// the script.
const QUICK: [&str; 6] = [
    "crowds.test.mjs",
    "meshes.test.mjs",
    "pointers.test.mjs",
    "refusals.test.mjs",
    "streams.test.mjs",
    "three.test.mjs",
];

/// Runs the tests in node, with and without WebAssembly, and compiles TypeScript against the types.
pub fn test_in_node() -> Result {
    js::build()?;
    js::install_for_tests()?;
    let tests = files::root().join("tests/js");
    let all = files::with_suffix(&tests, ".test.mjs")?;
    node_test(&[], &all)?;
    let is_quick = |file: &PathBuf| QUICK.iter().any(|name| file.ends_with(name));
    let quick: Vec<_> = all.into_iter().filter(is_quick).collect();
    node_test(&["--import", "./tests/js/no-wasm.mjs"], &quick)?;
    for types in files::with_suffix(&tests, ".ts")? {
        let mut tsc = shell::command("node");
        tsc.arg(npm::modules().join("typescript/bin/tsc"));
        let options = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext"];
        shell::run(tsc.args(options).arg(types))?;
    }
    Ok(())
}

/// Loads the package in a browser from a page with the content security policy of the demo's page.
pub fn test_in_browser() -> Result {
    js::build()?;
    js::install_for_tests()?;
    let root = files::root();
    let mounts = vec![
        Mount { at: "/three/", dir: npm::modules().join("three/build") },
        Mount { at: "/tests/", dir: root.join("tests") },
        Mount { at: "/", dir: root.join("tests/js/page") },
    ];
    let mounts = bench::mounts().into_iter().chain(mounts).collect();
    let url = Server::open(mounts, 0)?.spawn();
    browser::node_test("tests/web/page.test.mjs", &url, &[])
}

fn node_test(options: &[&str], tests: &[PathBuf]) -> Result {
    let mut node = shell::command("node");
    node.args(options).args(["--test", "--test-reporter=spec"]);
    shell::run(node.args(tests))
}
