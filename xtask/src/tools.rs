//! What the npm package is made with, from npm: locked in `bindings/js/tools/package-lock.json`.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::{files, npm, setup, shell};

/// Where they are, installed as the lock says.
pub fn install() -> Result<PathBuf> {
    setup::ensure(&[&setup::NODE])?;
    let dir = files::root().join("bindings/js/tools");
    npm::install_in(&dir)?;
    Ok(dir.join("node_modules"))
}

/// Makes JavaScript of wasm by Binaryen's wasm2js.
pub fn to_javascript(module: &Path, script: &Path, options: &[&str]) -> Result {
    let mut wasm2js = shell::command("node");
    wasm2js.arg(install()?.join("binaryen/bin/wasm2js")).arg(module).args(options);
    shell::run(wasm2js.arg("-o").arg(script))
}

/// Makes a script small by esbuild: `--minify` gives all that is not exported short names,
/// `--minify-whitespace` leaves the names.
pub fn minify(script: &Path, small: &Path, how: &str) -> Result {
    let mut esbuild = shell::command("node");
    esbuild.arg(install()?.join("esbuild/bin/esbuild")).arg(script);
    esbuild.args([how, "--log-level=warning"]);
    shell::run(esbuild.arg(format!("--outfile={}", small.display())))
}
