//! The npm package `muslin`: built into `dist/js`, tested in node and in a browser.

use std::path::PathBuf;

use crate::failure::{During, Failure, Result};
use crate::serve::{Mount, Server};
use crate::{bench, browser, files, no_wasm, npm, shell, tools, wasm};

/// Where the package is built.
pub fn dir() -> PathBuf {
    files::root().join("dist/js")
}

/// Builds the package.
pub fn build() -> Result {
    let hand_written = files::root().join("bindings/js/package");
    if !hand_written.is_dir() {
        return Err(Failure::new(
            "bindings/js/package is missing: it holds the package's own files",
        ));
    }
    files::make_empty(&dir())?;
    let vectors = module("vectors", |package| wasm::compile(package, wasm::FLAGS))?;
    let plain = module("plain", |package| wasm::compile(package, wasm::PLAIN))?;
    let small = module("small", wasm::compile_small)?;
    let script = files::read(&vectors.join("raw_bg.js"))?;
    for other in [&plain, &small] {
        if files::read(&other.join("raw_bg.js"))? != script {
            return Err(Failure::new(
                "the modules are bound differently, with vectors and without",
            ));
        }
    }
    tools::minify(&vectors.join("raw_bg.js"), &dir().join("raw.js"), "--minify-whitespace")?;
    let code = no_wasm::convert(&small.join("raw_bg.wasm"), &small)?;
    let [vectors, plain] = [vectors, plain].map(|dir| dir.join("raw_bg.wasm"));
    for (from, name) in [(vectors, "raw_bg.wasm"), (plain, "plain_bg.wasm"), (code, "code.js")] {
        std::fs::copy(from, dir().join(name)).during(|| format!("writing {name}"))?;
    }
    files::copy_all(&hand_written, &dir())?;
    for license in ["LICENSE-MIT", "LICENSE-APACHE"] {
        let text = files::read(&files::root().join(license))?;
        files::write(&dir().join(license), &text)?;
    }
    inline()?;
    name_build()?;
    println!("the package is in dist/js");
    Ok(())
}

/// Builds a module and what binds it; gives the folder.
fn module(name: &str, compile: impl Fn(&str) -> Result<PathBuf>) -> Result<PathBuf> {
    let to = files::target().join("js").join(name);
    files::make(&to)?;
    wasm::bind(&compile("muslin-js")?, &to, "raw")?;
    Ok(to)
}

/// The module as text, for those who want no second file.
fn inline() -> Result {
    use base64::Engine;
    let module = dir().join("raw_bg.wasm");
    let bytes = std::fs::read(&module).during(|| format!("reading {}", module.display()))?;
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    files::write(&dir().join("bytes.js"), &format!("export default \"{text}\";\n"))
}

/// Writes down of which version and commit the package is.
fn name_build() -> Result {
    let version = env!("CARGO_PKG_VERSION");
    let manifest = dir().join("package.json");
    let text = files::read(&manifest)?;
    let filled = text.replace("\"version\": \"0.0.0\"", &format!("\"version\": \"{version}\""));
    if filled == text {
        return Err(Failure::new("package.json has no version 0.0.0 to be filled in"));
    }
    files::write(&manifest, &filled)?;
    // From an archive of the sources there is no commit to name.
    let mut git = shell::command("git");
    git.args(["describe", "--always", "--abbrev=40", "--exclude=*", "--dirty"]);
    let commit = match git.stderr(std::process::Stdio::null()).output() {
        Ok(said) if said.status.success() => {
            format!("\"{}\"", String::from_utf8_lossy(&said.stdout).trim())
        }
        _ => "null".into(),
    };
    let compiler = shell::output(shell::command("rustc").arg("--version"))?;
    let compiler = compiler.trim();
    let build = format!(
        "{{\n  \"version\": \"{version}\",\n  \"commit\": {commit},\n  \"compiler\": \"{compiler}\"\n}}\n"
    );
    files::write(&dir().join("build.json"), &build)
}

/// Tests that take no minute without WebAssembly either; `builds` plays the script there.
const QUICK: [&str; 5] = [
    "meshes.test.mjs",
    "pointers.test.mjs",
    "refusals.test.mjs",
    "streams.test.mjs",
    "three.test.mjs",
];

fn node_test(options: &[&str], tests: &[PathBuf]) -> Result {
    let mut node = shell::command("node");
    node.args(options).args(["--test", "--test-reporter=spec"]);
    shell::run(node.args(tests))
}

/// Runs the tests in node, and has the compiler read the types.
pub fn test() -> Result {
    build()?;
    npm::install()?;
    let tests = files::root().join("tests/js");
    let all = files::ending(&tests, ".test.mjs")?;
    node_test(&[], &all)?;
    let is_quick = |file: &PathBuf| QUICK.iter().any(|name| file.ends_with(name));
    let quick: Vec<_> = all.into_iter().filter(is_quick).collect();
    node_test(&["--import", "./tests/js/no-wasm.mjs"], &quick)?;
    for types in files::ending(&tests, ".ts")? {
        let mut tsc = shell::command("node");
        tsc.arg(npm::modules().join("typescript/bin/tsc"));
        let how = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext"];
        shell::run(tsc.args(how).arg(types))?;
    }
    Ok(())
}

/// Loads the package in a browser, from a page that is as strict as ours.
pub fn test_page() -> Result {
    build()?;
    npm::install()?;
    let root = files::root();
    let mounts = vec![
        Mount { at: "/three/", dir: npm::modules().join("three/build") },
        Mount { at: "/tests/", dir: root.join("tests") },
        Mount { at: "/", dir: root.join("tests/js/page") },
    ];
    let mounts = bench::mounts().into_iter().chain(mounts).collect();
    let url = Server::open(mounts, 0)?.run_aside();
    browser::node_test("tests/web/page.test.mjs", &url, &[])
}
