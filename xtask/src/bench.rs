//! The benchmarks: tables of kernels and whole ticks, natively, in node and in a browser.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::serve::{Mount, Server};
use crate::{files, js, npm, setup, shell, wasm};

/// The tables that are run natively; in node they go by one name.
const NATIVE: [&str; 6] = ["kernels", "ticks", "shreds", "layers", "scenes", "receipt"];
const NODE: &str = "node";
/// What a page pays, in a browser; run only when it is named.
const PAGE: &str = "page";
/// Others that have cloth for a page; run only when they are named, as they have to be fetched.
const PEERS: &str = "peers";
/// Leaves vectors wider than those of AVX2 unused, as on machines that have no others.
const AVX2: &str = "avx2";
/// Runs everything once and tiny.
const TEST: &str = "--test";

/// Prints the tables that are named, or all.
pub fn run(options: &[String]) -> Result {
    let words: Vec<_> = options.iter().map(String::as_str).filter(|word| *word != "--").collect();
    let is_known =
        |word: &str| [NODE, PAGE, PEERS, AVX2, TEST].contains(&word) || NATIVE.contains(&word);
    if let Some(unknown) = words.iter().find(|word| !is_known(word)) {
        return Err(Failure::new(format!(
            "`cargo xtask bench` knows no {unknown:?}; it takes kernels, ticks, shreds, layers, scenes, receipt, node, page, peers, avx2 and --test"
        )));
    }
    let test: &[&str] = if words.contains(&TEST) { &[TEST] } else { &[] };
    let all = words.iter().all(|word| [AVX2, TEST].contains(word));
    let wanted = NATIVE.iter().copied().filter(|name| all || words.contains(name));
    let wanted: Vec<_> = wanted.collect();
    if !wanted.is_empty() {
        // One thread costs the same with the feature as without.
        let tables = ["bench", "--package=muslin", "--features=parallel", "--bench=tables", "--"];
        let mut cargo = shell::cargo(&tables);
        if words.contains(&AVX2) {
            cargo.env("RUSTFLAGS", "--cfg muslin_at_most_avx2");
            cargo.env("CARGO_TARGET_DIR", files::root().join("target/avx2"));
        }
        shell::run(cargo.args(wanted).args(test))?;
    }
    if words.contains(&NODE) || all && !words.contains(&AVX2) {
        in_node(test)?;
    }
    if words.contains(&PAGE) {
        in_a_page(test)?;
    }
    if words.contains(&PEERS) {
        beside_peers(test)?;
    }
    Ok(())
}

/// The npm package in a browser, beside a loop by hand.
fn in_a_page(test: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE, &setup::CHROMIUM])?;
    js::build()?;
    npm::install()?;
    in_chromium("page/table.mjs", "page/index.html", test)
}

/// The npm package beside its peers, in node and in a browser.
fn beside_peers(test: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE, &setup::CHROMIUM])?;
    js::build()?;
    npm::install()?;
    npm::install_in(&dir().join("peers"))?;
    in_chromium("peers/node.mjs", "peers/index.html", test)
}

/// Runs a script of the benchmarks that plays one of their pages.
fn in_chromium(script: &str, page: &str, test: &[&str]) -> Result {
    let url = Server::open(mounts(), 0)?.run_aside() + page;
    let chromium = setup::chromium().ok_or_else(|| Failure::new("chromium is missing"))?;
    let mut node = shell::command("node");
    node.arg(dir().join(script)).args(test);
    shell::run(node.env("MUSLIN_URL", url).env("MUSLIN_CHROMIUM", chromium))
}

fn dir() -> PathBuf {
    files::root().join("benches")
}

/// Where pages find the npm package, the benchmarks and each other.
pub fn mounts() -> Vec<Mount> {
    vec![
        Mount { at: "/js/", dir: js::dir() },
        Mount { at: "/peers/", dir: dir().join("peers") },
        Mount { at: "/page/", dir: dir().join("page") },
    ]
}

/// The npm package beside the plain loop as a wasm module of its own.
fn in_node(test: &[&str]) -> Result {
    setup::ensure(&[&setup::NODE])?;
    js::build()?;
    let plain = wasm::compile("muslin-plain", wasm::PLAIN)?;
    let mut node = shell::command("node");
    node.arg(dir().join("node/tables.mjs"));
    shell::run(node.arg(plain).args(test))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_table_is_named() {
        let failure = run(&["kernel".into()]).err().unwrap().to_string();
        assert!(failure.contains("\"kernel\"") && failure.contains("ticks"), "{failure}");
    }
}
