//! From a crate to a wasm module with the JavaScript that loads it.

use std::path::{Path, PathBuf};

use wasm_bindgen_cli_support::Bindgen;

use crate::failure::{During, Result};
use crate::{files, setup, shell};

/// What Rust calls the web.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Four lanes at a time; every current browser and node has them. LLVM's reduction of loop strength
/// is off: what it makes of addresses cannot be folded into loads and stores of wasm. What is called from several
/// places is woven into fewer of them, as `c` has it.
pub const FLAGS: &str =
    "-C target-feature=+simd128 -C llvm-args=--disable-lsr -C llvm-args=-inline-threshold=50";

/// For engines that have no vectors.
pub const PLAIN: &str = "-C target-feature=-simd128 -C llvm-args=-inline-threshold=50";

/// Nothing that engines did not have from the start but copies within memory: what JavaScript can be made of.
const OLD: &str = "-C target-feature=-simd128,-nontrapping-fptoint,-sign-ext";

/// Builds the library of `package` for a page and puts `name.js` and `name_bg.wasm` into `dir`.
pub fn build(package: &str, dir: &Path, name: &str) -> Result {
    let module = compile(package, FLAGS)?;
    let during = || format!("binding {}", module.display());
    let mut bindgen = Bindgen::new();
    bindgen.web(true).during(during)?.input_path(&module);
    write(&mut bindgen, dir, name).during(during)
}

/// Binds a module to JavaScript that is told what it exports, so that anything may stand in for WebAssembly:
/// `name_bg.wasm` and `name_bg.js`, with neither tables of JavaScript's values nor results of several.
pub fn bind(module: &Path, dir: &Path, name: &str) -> Result {
    let during = || format!("binding {}", module.display());
    let mut bytes = std::fs::read(module).during(during)?;
    for feature in ["reference-types", "multivalue"] {
        disclaim(&mut bytes, feature);
    }
    let mut bindgen = Bindgen::new();
    bindgen.bundler(true).during(during)?.input_bytes(name, bytes);
    write(&mut bindgen, dir, name).during(during)
}

/// Takes back that a module uses a feature. Rust's standard library says so of some that nothing uses.
fn disclaim(module: &mut [u8], feature: &str) {
    let claim = [&[b'+', feature.len() as u8], feature.as_bytes()].concat();
    if let Some(at) = module.windows(claim.len()).rposition(|window| window == claim) {
        module[at] = b'-';
    }
}

/// Compiles the library of `package` to a module with these flags.
pub fn compile(package: &str, flags: &str) -> Result<PathBuf> {
    compile_with(package, flags, &[])
}

/// Compiles the library of `package` to a module of small functions that JavaScript can be made of.
pub fn compile_small(package: &str) -> Result<PathBuf> {
    compile_with(package, OLD, &["--config", "profile.release.opt-level=\"s\""])
}

fn compile_with(package: &str, flags: &str, options: &[&str]) -> Result<PathBuf> {
    setup::ensure_target(TARGET)?;
    let mut cargo = shell::cargo(&["rustc", "--release", "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--target", TARGET, "--package", package]).args(options);
    // A caller's flags would replace these.
    cargo.env("RUSTFLAGS", flags).env_remove("CARGO_ENCODED_RUSTFLAGS");
    shell::run(&mut cargo)?;
    let built = package.replace('-', "_") + ".wasm";
    Ok(files::target().join(TARGET).join("release").join(built))
}

fn write(bindgen: &mut Bindgen, dir: &Path, name: &str) -> Result {
    let during = || String::from("wasm-bindgen");
    bindgen
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .out_name(name)
        .generate(dir)
        .during(during)
}
