//! Compiles a crate to a wasm module and writes the JavaScript that loads it.

use std::path::{Path, PathBuf};

use wasm_bindgen_cli_support::Bindgen;

use crate::failure::{During, Result};
use crate::{c, files, function_order, setup, shell, tools, traps};

/// The Rust target of pages.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Compiler flags for vectors of four lanes, which every current browser and node has. LLVM's loop
/// strength reduction is off: the addresses that it computes cannot be folded into the loads and
/// stores of wasm. Inlining is limited as in `c`, and loops are unrolled less than at level 3, which
/// makes the module a twentieth smaller and ticks 0 to 3 % slower.
pub const FLAGS: &str = "-C target-feature=+simd128 -C llvm-args=--disable-lsr \
                         -C opt-level=2 -C llvm-args=-inline-threshold=50";

/// Compiler flags for engines without vectors.
pub const PLAIN: &str = "-C target-feature=-simd128 -C llvm-args=--disable-lsr \
     -C opt-level=2 -C llvm-args=-inline-threshold=50";

/// Compiler flags for the first version of wasm, with bulk memory operations: what wasm2js can
/// translate. Inlining would make the script larger, not faster.
const OLD: &str = "-C target-feature=-simd128,-nontrapping-fptoint,-sign-ext \
                   -C llvm-args=--disable-lsr -C llvm-args=-inline-threshold=1";

/// Leaves out what `muslin/light` does not have, see `bindings/js/Cargo.toml`.
const LIGHT: [&str; 1] = ["--no-default-features"];

/// Compiler flags for `muslin/light`: as [`FLAGS`], but loops are unrolled less, which makes the module
/// a further 3.5 % smaller and ticks up to 6 % slower, and less is inlined, which makes it 1.3 % smaller.
const LIGHT_FLAGS: &str = "-C target-feature=+simd128 -C llvm-args=--disable-lsr \
     -C opt-level=2 -C llvm-args=-inline-threshold=20 \
     -C llvm-args=-unroll-runtime=false -C llvm-args=-unroll-threshold=50";

/// Compiles the simulation for size, and the exports for the least size.
const SMALL: [&str; 4] = [
    "--config",
    "profile.release.opt-level=\"s\"",
    "--config",
    "profile.release.package.muslin-js.opt-level=\"z\"",
];

/// Builds the library of `package` for a page, and writes `name.js` and `name_bg.wasm` into `dir`.
pub fn build(package: &str, dir: &Path, name: &str) -> Result {
    let module = compile(package, FLAGS)?;
    let during = || format!("binding {}", module.display());
    let mut bindgen = Bindgen::new();
    bindgen.web(true).during(during)?.input_path(&module);
    write(&mut bindgen, dir, name).during(during)
}

/// Writes `name_bg.wasm` and `name_bg.js` into `dir`, with traps instead of panics, if wanted
/// optimised by Binaryen, and with similar functions next to each other. The script receives
/// the exports of the module from its caller, so that JavaScript can replace the module; it needs
/// neither reference types nor multiple results.
pub fn bind(module: &Path, dir: &Path, name: &str, is_optimized: bool) -> Result {
    let during = || format!("binding {}", module.display());
    let mut bytes = traps::from_panics(&std::fs::read(module).during(during)?)?;
    for feature in ["reference-types", "multivalue"] {
        remove_feature(&mut bytes, feature);
    }
    let mut bindgen = Bindgen::new();
    bindgen.bundler(true).during(during)?.input_bytes(name, bytes);
    write(&mut bindgen, dir, name).during(during)?;
    let module = dir.join(format!("{name}_bg.wasm"));
    if is_optimized {
        tools::optimize(&module)?;
    }
    let bytes = std::fs::read(&module).during(during)?;
    std::fs::write(&module, function_order::in_module(&bytes)?).during(during)
}

/// Removes a feature from those that a module says it uses. Rust's standard library lists some that
/// nothing uses.
fn remove_feature(module: &mut [u8], feature: &str) {
    let entry = [&[b'+', feature.len() as u8], feature.as_bytes()].concat();
    if let Some(at) = module.windows(entry.len()).rposition(|window| window == entry) {
        module[at] = b'-';
    }
}

/// Compiles the library of `package` to a module with the compiler flags `flags`; returns its path.
pub fn compile(package: &str, flags: &str) -> Result<PathBuf> {
    compile_with(package, flags, &[])
}

/// Compiles the library of `package` to a module for `muslin/light`; returns its path.
pub fn compile_light(package: &str) -> Result<PathBuf> {
    compile_with(package, LIGHT_FLAGS, &LIGHT)
}

/// Compiles the library of `package` to a module of small functions that wasm2js can translate;
/// returns its path.
pub fn compile_small(package: &str) -> Result<PathBuf> {
    compile_with(package, OLD, &SMALL)
}

fn compile_with(package: &str, flags: &str, options: &[&str]) -> Result<PathBuf> {
    setup::ensure_target(TARGET)?;
    let mut cargo = shell::cargo(&["rustc", "--release", "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--target", TARGET, "--package", package]).args(options);
    let mut flags: Vec<String> = flags.split_whitespace().map(String::from).collect();
    flags.extend(c::remapped_paths()?);
    // This replaces flags from the environment. It separates flags by the character 0x1f.
    cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"));
    shell::run(&mut cargo)?;
    let built = package.replace('-', "_") + ".wasm";
    Ok(files::target().join(TARGET).join("release").join(built))
}

/// Writes the module and its script. The section that lists the features of the module is removed,
/// since no engine reads it.
fn write(bindgen: &mut Bindgen, dir: &Path, name: &str) -> Result {
    let during = || String::from("wasm-bindgen");
    let mut output = bindgen
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .out_name(name)
        .generate_output()
        .during(during)?;
    output.wasm_mut().customs.remove_raw("target_features");
    output.emit(dir).during(during)
}
