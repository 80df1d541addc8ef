//! Tests that need a browser: node scripts that drive Chromium at an address.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Stdio};

use crate::failure::{During, Failure, Result};
use crate::{npm, setup, shell};

/// Runs a test file of node against a page; `paths` are further variables that it reads.
pub fn node_test(file: &str, url: &str, paths: &[(&str, &PathBuf)]) -> Result {
    setup::ensure(&[&setup::CHROMIUM])?;
    npm::install()?;
    let chromium = setup::chromium().ok_or_else(|| Failure::new("chromium is missing"))?;
    let mut node = shell::command("node");
    node.args(["--test", "--test-reporter=spec", file]);
    node.env("MUSLIN_URL", url).env("MUSLIN_CHROMIUM", chromium);
    shell::run(node.envs(paths.iter().copied()))
}

/// Another run of xtask that serves a page, until this is dropped.
pub struct Served {
    child: Child,
    /// Where the page is.
    pub url: String,
}

impl Served {
    /// Starts a chore and waits until it says where it serves.
    pub fn by(args: &[&str]) -> Result<Self> {
        let typed = format!("cargo xtask {}", args.join(" "));
        println!("$ {typed}");
        let child = shell::xtask(args)?.stdout(Stdio::piped()).spawn();
        let mut served =
            Self { child: child.during(|| format!("starting `{typed}`"))?, url: String::new() };
        let output = served.child.stdout.take().ok_or_else(|| Failure::new("no output"))?;
        for line in BufReader::new(output).lines() {
            let line = line.during(|| format!("reading what `{typed}` prints"))?;
            println!("{line}");
            let mut words = line.split_whitespace();
            if let Some(url) = words.find(|word| word.starts_with("http://127.0.0.1:")) {
                served.url = url.into();
                return Ok(served);
            }
        }
        Err(Failure::new(format!("`{typed}` ended without serving anything")))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // If it has ended already there is nothing to end.
        self.child.kill().ok();
        self.child.wait().ok();
    }
}
