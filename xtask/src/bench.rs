//! Runs the benchmarks: tables of kernels and whole ticks, natively, in node and in a browser.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::serve::{Mount, Server};
use crate::{files, js, npm, setup, shell, wasm};

/// The tables of native code; in node all tables have one name.
const NATIVE: [&str; 7] = ["kernels", "ticks", "shreds", "layers", "scenes", "receipt", "crowd"];
const NODE: &str = "node";
/// The cost of a page in a browser; runs only by name.
const PAGE: &str = "page";
/// Other cloth libraries for pages; they run only by name, since npm downloads them.
const PEERS: &str = "peers";
/// Runs every case once and with small meshes, as a test.
const TEST: &str = "--test";

/// The cost of meshes in files; what follows it are arguments of its own.
const MESHES: &str = "meshes";

/// Prints the tables that are named; without names, all native tables and the one in node.
pub fn run(arguments: &[String]) -> Result {
    if let Some((MESHES, rest)) = arguments.split_first().map(|(first, rest)| (&**first, rest)) {
        let is_test = rest.iter().any(|word| word == TEST);
        let profile = if is_test { "dev" } else { "release" };
        let build = ["run", "--quiet", "--package=muslin-meshes", "--profile", profile, "--"];
        return shell::run(shell::cargo(&build).args(rest));
    }
    let words: Vec<_> = arguments.iter().map(String::as_str).filter(|word| *word != "--").collect();
    let is_known = |word: &str| [NODE, PAGE, PEERS, TEST].contains(&word) || NATIVE.contains(&word);
    if let Some(unknown) = words.iter().find(|word| !is_known(word)) {
        return Err(Failure::new(format!(
            "`cargo xtask bench` knows no {unknown:?}; it takes kernels, ticks, shreds, layers, scenes, \
             receipt, crowd, node, page, peers and --test, or meshes with files"
        )));
    }
    let options: &[&str] = if words.contains(&TEST) { &[TEST] } else { &[] };
    let all = words.iter().all(|word| *word == TEST);
    let wanted = NATIVE.iter().copied().filter(|name| all || words.contains(name));
    let wanted: Vec<_> = wanted.collect();
    if !wanted.is_empty() {
        let mut cargo = shell::cargo(&["bench", "--package=muslin"]);
        if words.contains(&TEST) {
            // Nobody reads times of a test; step `rust` has built the library in this profile.
            cargo.args(["--profile", "dev"]);
        }
        cargo.args(["--bench=tables", "--"]);
        shell::run(cargo.args(wanted).args(options))?;
    }
    if words.contains(&NODE) || all {
        run_node(options)?;
    }
    if words.contains(&PAGE) {
        run_page(options)?;
    }
    if words.contains(&PEERS) {
        run_peers(options)?;
    }
    Ok(())
}

/// Times the npm package in a browser beside a handwritten loop.
fn run_page(options: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE, &setup::CHROMIUM])?;
    js::build()?;
    js::install_for_tests()?;
    run_in_chromium("page/table.mjs", "page/index.html", options)
}

/// Times the npm package beside other cloth libraries, in node and in a browser.
fn run_peers(options: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE, &setup::CHROMIUM])?;
    js::build()?;
    js::install_for_tests()?;
    npm::install_in(&dir().join("peers"))?;
    run_in_chromium("peers/node.mjs", "peers/index.html", options)
}

/// Runs a benchmark script that opens a benchmark page in Chromium.
fn run_in_chromium(script: &str, page: &str, options: &[&str]) -> Result {
    let url = Server::open(mounts(), 0)?.spawn() + page;
    let chromium = setup::chromium().ok_or_else(|| Failure::new("chromium is missing"))?;
    let mut node = shell::command("node");
    node.arg(dir().join(script)).args(options);
    shell::run(node.env("MUSLIN_URL", url).env("MUSLIN_CHROMIUM", chromium))
}

fn dir() -> PathBuf {
    files::root().join("benches")
}

/// The folders that benchmark pages load from: the npm package and the benchmarks.
pub fn mounts() -> Vec<Mount> {
    vec![
        Mount { at: "/js/", dir: js::dir() },
        Mount { at: "/peers/", dir: dir().join("peers") },
        Mount { at: "/page/", dir: dir().join("page") },
    ]
}

/// Times the npm package in node beside the plain loop, compiled to a wasm module of its own.
fn run_node(options: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE])?;
    js::build()?;
    let plain = wasm::compile("muslin-plain", wasm::PLAIN)?;
    let mut node = shell::command("node");
    node.arg(dir().join("node/tables.mjs"));
    shell::run(node.arg(plain).args(options))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_table_is_refused_by_name() {
        let failure = run(&["kernel".into()]).err().unwrap().to_string();
        assert!(failure.contains("\"kernel\"") && failure.contains("ticks"), "{failure}");
    }
}
