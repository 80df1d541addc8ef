//! The npm package once more, with the module as JavaScript: for pages that may not run WebAssembly.

use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};
use crate::{files, js, npm, shell, wasm};

/// What Rust's standard library uses beyond the first version of WebAssembly, …
const HAS: [&str; 6] = [
    "--enable-bulk-memory",
    "--enable-sign-ext",
    "--enable-nontrapping-float-to-int",
    "--enable-reference-types",
    "--enable-multivalue",
    "--enable-mutable-globals",
];

/// … and what puts that into the terms of the first.
const LOWER: [&str; 4] = [
    "--signext-lowering",
    "--llvm-nontrapping-fptoint-lowering",
    "--llvm-memory-copy-fill-lowering",
    "--strip-target-features",
];

/// How the bound module is made smaller. Engines leave functions uncompiled that are too long, so that
/// few may take in others.
const SMALL: [&str; 4] = [
    "--mvp-features",
    "-O2",
    "--one-caller-inline-max-function-size=500",
    "--flexible-inline-max-function-size=20",
];

/// What the JavaScript of a module begins and ends with, in place of which stand lines of ours.
const IMPORTS: &str = "import * as $_raw_bg_js from './raw_bg.js';";
const EXPORTS: &str = "var retasmFunc = asmFunc(";
const TRAP: &str = "function wasm2js_trap() { throw new Error('abort'); }";

/// How the binding finds that memory has moved: a buffer of JavaScript's own is never emptied.
const MOVED: &str = ".byteLength === 0";
const MOVED_HERE: &str = ".buffer !== wasm.memory.buffer";

/// Builds it into the package, beside the rest.
pub fn build() -> Result {
    npm::install()?;
    let work = files::target().join("js-without-wasm");
    let (bound, code, was) = (work.join("bound"), work.join("code.js"), work.join("was.wasm"));
    let module = wasm::compile_oldest("muslin-js")?;
    let read = |path: &Path| std::fs::read(path).during(|| format!("reading {}", path.display()));
    // It takes a minute, and tests ask for it more than once.
    if !was.is_file() || read(&was)? != read(&module)? {
        files::make_empty(&work)?;
        translate(&module, &bound, &code)?;
        std::fs::copy(&module, &was).during(|| format!("writing {}", was.display()))?;
    }
    compose(&bound, &code)
}

/// Binds a module, and makes JavaScript of it.
fn translate(module: &Path, bound: &Path, code: &Path) -> Result {
    let [low, small] = ["low.wasm", "small.wasm"].map(|name| code.with_file_name(name));
    binaryen("wasm-opt", module, &low, &[&HAS[..], &LOWER, &["-g"]].concat())?;
    wasm::bind_module(&low, bound, "raw")?;
    binaryen("wasm-opt", &bound.join("raw_bg.wasm"), &small, &SMALL)?;
    binaryen("wasm2js", &small, code, &["-O"])
}

fn dir() -> PathBuf {
    js::dir().join("without-wasm")
}

/// The package's own files, with an engine of ours where they speak of WebAssembly.
fn compose(bound: &Path, code: &Path) -> Result {
    let ours = files::root().join("bindings/js");
    files::make_empty(&dir())?;
    for script in files::ending(&ours.join("package"), ".js")? {
        let name = script.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // The adapter is for the cloths of any build, and these bytes are those of the module.
        if !["three.js", "inline.js"].contains(&name.as_str()) {
            files::write(&dir().join(name), &on_our_engine(files::read(&script)?))?;
        }
    }
    let raw = files::read(&bound.join("raw.js"))?;
    let raw = replaced(&raw, MOVED, MOVED_HERE)?;
    files::write(&dir().join("raw.js"), &on_our_engine(raw))?;
    files::copy_all(&ours.join("without-wasm"), &dir())?;
    let text = files::read(code)?;
    let Some((body, _)) = text.split_once(EXPORTS) else {
        return Err(changed(EXPORTS));
    };
    let Some((_, body)) = body.split_once(IMPORTS) else {
        return Err(changed(IMPORTS));
    };
    let body = replaced(body, TRAP, "function wasm2js_trap() { trap(); }")?;
    let whole = format!(
        "import {{ trap }} from \"./trap.js\";\n{body}\nexport {{ asmFunc as instantiate }};\n"
    );
    let ours = code.with_file_name("ours.js");
    files::write(&ours, &whole)?;
    minify(&ours, &dir().join("code.js"))
}

fn on_our_engine(script: String) -> String {
    if script.contains("WebAssembly") {
        return format!("import {{ WebAssembly }} from \"./engine.js\";\n{script}");
    }
    script
}

fn replaced(text: &str, old: &str, new: &str) -> Result<String> {
    if !text.contains(old) {
        return Err(changed(old));
    }
    Ok(text.replace(old, new))
}

fn changed(what: &str) -> Failure {
    Failure::new(format!("what makes JavaScript of a module does not write `{what}` any more"))
}

fn binaryen(tool: &str, from: &Path, to: &Path, options: &[&str]) -> Result {
    let mut node = shell::command("node");
    node.arg(npm::modules().join("binaryen/bin").join(tool)).arg(from).arg("-o").arg(to);
    shell::run(node.args(options))
}

fn minify(from: &Path, to: &Path) -> Result {
    let mut node = shell::command("node");
    node.arg(npm::modules().join("esbuild/bin/esbuild")).arg(from);
    let mut outfile = std::ffi::OsString::from("--outfile=");
    outfile.push(to);
    shell::run(node.args(["--minify", "--log-level=warning"]).arg(outfile))
        .during(|| format!("minifying {}", from.display()))
}
