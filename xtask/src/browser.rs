//! Tests in a browser: node scripts that control Chromium.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Stdio};

use crate::failure::{During, Failure, Result};
use crate::{npm, setup, shell};

/// Runs a test file in node against the page at `url`. `paths` are environment variables for it,
/// each with its value.
pub fn node_test(file: &str, url: &str, paths: &[(&str, &PathBuf)]) -> Result {
    setup::ensure(&[&setup::CHROMIUM])?;
    npm::install()?;
    let chromium = setup::chromium().ok_or_else(|| Failure::new("chromium is missing"))?;
    let mut node = shell::command("node");
    node.args(["--test", "--test-reporter=spec", file]);
    node.env("MUSLIN_URL", url).env("MUSLIN_CHROMIUM", chromium);
    shell::run(node.envs(paths.iter().copied()))
}

/// Another process of xtask that serves a page until this is dropped.
pub struct ServerProcess {
    child: Child,
    /// The address of the page.
    pub url: String,
}

impl ServerProcess {
    /// Starts a chore and waits until it prints the address of its page.
    pub fn start(args: &[&str]) -> Result<Self> {
        let typed = format!("cargo xtask {}", args.join(" "));
        println!("$ {typed}");
        let child = shell::xtask(args)?.stdout(Stdio::piped()).spawn();
        let mut server =
            Self { child: child.during(|| format!("starting `{typed}`"))?, url: String::new() };
        let output = server.child.stdout.take().ok_or_else(|| Failure::new("no output"))?;
        for line in BufReader::new(output).lines() {
            let line = line.during(|| format!("reading the output of `{typed}`"))?;
            println!("{line}");
            let mut words = line.split_whitespace();
            if let Some(url) = words.find(|word| word.starts_with("http://127.0.0.1:")) {
                server.url = url.into();
                return Ok(server);
            }
        }
        Err(Failure::new(format!("`{typed}` ended without serving a page")))
    }
}

impl Drop for ServerProcess {
    fn drop(&mut self) {
        // Both fail if the process has ended already, which does no harm.
        self.child.kill().ok();
        self.child.wait().ok();
    }
}
