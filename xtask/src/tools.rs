//! The npm programs that build the npm package; `bindings/js/tools/package-lock.json` lists them.

use std::path::{Path, PathBuf};

use crate::failure::Result;
use crate::{files, npm, shell};

/// Installs them and returns their folder.
pub fn install() -> Result<PathBuf> {
    let dir = files::root().join("bindings/js/tools");
    npm::install_in(&dir)?;
    Ok(dir.join("node_modules"))
}

/// Translates a wasm module into JavaScript with Binaryen's wasm2js.
pub fn to_javascript(module: &Path, script: &Path, options: &[&str]) -> Result {
    let mut wasm2js = shell::command("node");
    wasm2js.arg(install()?.join("binaryen/bin/wasm2js")).arg(module).args(options);
    shell::run(wasm2js.arg("-o").arg(script))
}

/// The features of wasm that the compiler uses.
const FEATURES: [&str; 5] =
    ["simd", "bulk-memory", "sign-ext", "nontrapping-float-to-int", "mutable-globals"];

/// Optimises a wasm module in place with Binaryen's wasm-opt, which may use the features of wasm that
/// the compiler uses. Higher levels make the module larger after compression.
pub fn optimize(module: &Path) -> Result {
    let mut wasm_opt = shell::command("node");
    wasm_opt.arg(install()?.join("binaryen/bin/wasm-opt")).arg(module);
    wasm_opt.args(["-O1", "--mvp-features"]).args(FEATURES.map(|name| format!("--enable-{name}")));
    shell::run(wasm_opt.arg("-o").arg(module))
}

/// Writes a smaller script with esbuild. `option` is `--minify`, which also shortens all names that
/// are not exported, or `--minify-whitespace`, which keeps names.
pub fn minify(script: &Path, small: &Path, option: &str) -> Result {
    let mut esbuild = shell::command("node");
    esbuild.arg(install()?.join("esbuild/bin/esbuild")).arg(script);
    esbuild.args([option, "--log-level=warning"]);
    shell::run(esbuild.arg(format!("--outfile={}", small.display())))
}
