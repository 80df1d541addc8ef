//! From a crate to a wasm module with the JavaScript that loads it.

use std::path::{Path, PathBuf};

use wasm_bindgen_cli_support::Bindgen;

use crate::failure::{During, Result};
use crate::{files, setup, shell};

/// What Rust calls the web.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Four lanes at a time; every current browser and node has them. LLVM's reduction of loop strength
/// is off: what it makes of addresses cannot be folded into loads and stores of wasm.
pub const FLAGS: &str = "-C target-feature=+simd128 -C llvm-args=--disable-lsr";

/// Builds the library of `package` for the web and puts `name.js` and `name_bg.wasm` into `dir`;
/// `name.d.ts` too if there are to be `types`.
pub fn build(package: &str, dir: &Path, name: &str, types: bool) -> Result {
    let module = compile(package, FLAGS)?;
    bind(&module, dir, name, types).during(|| format!("binding {}", module.display()))
}

/// As `build`, from a module that is there.
pub fn bind_module(module: &Path, dir: &Path, name: &str) -> Result {
    bind(module, dir, name, true).during(|| format!("binding {}", module.display()))
}

/// Compiles the library of `package` to a module that asks nothing of the engine, not even vectors.
pub fn compile_plain(package: &str) -> Result<PathBuf> {
    compile(package, "-C target-feature=-simd128")
}

fn compile(package: &str, flags: &str) -> Result<PathBuf> {
    setup::ensure_target(TARGET)?;
    let mut cargo = shell::cargo(&["rustc", "--release", "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--target", TARGET, "--package", package]);
    // A caller's flags would replace these.
    cargo.env("RUSTFLAGS", flags).env_remove("CARGO_ENCODED_RUSTFLAGS");
    shell::run(&mut cargo)?;
    let built = package.replace('-', "_") + ".wasm";
    Ok(files::target().join(TARGET).join("release").join(built))
}

fn bind(module: &Path, dir: &Path, name: &str, types: bool) -> Result {
    let during = || String::from("wasm-bindgen");
    Bindgen::new()
        .web(true)
        .during(during)?
        .typescript(types)
        .remove_name_section(true)
        .remove_producers_section(true)
        .out_name(name)
        .input_path(module)
        .generate(dir)
        .during(during)
}
