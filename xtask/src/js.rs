//! Builds the npm package `muslin` into `dist/js`.

use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};
use crate::{files, no_wasm, npm, shell, tools, wasm};

/// The folder that the package is built in.
pub fn dir() -> PathBuf {
    files::root().join("dist/js")
}

/// Builds the package, once in a run of the tests.
pub fn build() -> Result {
    files::once_in_run("npm-package", build_package)
}

/// Builds four modules (with vectors, without, of `muslin/light`, and as JavaScript), scripts and
/// licences.
fn build_package() -> Result {
    let scripts = files::root().join("bindings/js/package");
    if !scripts.is_dir() {
        return Err(Failure::new(
            "bindings/js/package is missing; it holds the scripts of the package",
        ));
    }
    files::create_empty_dir(&dir())?;
    let vectors = module("vectors", |package| wasm::compile(package, wasm::FLAGS))?;
    let plain = module("plain", |package| wasm::compile(package, wasm::PLAIN))?;
    let light = module("light", wasm::compile_light)?;
    let small = module(SMALL, wasm::compile_small)?;
    // Minified, because comments and names of arguments may differ.
    for built in [&vectors, &plain, &light, &small] {
        tools::minify(&built.join("raw_bg.js"), &built.join("raw.js"), "--minify")?;
    }
    let script = files::read(&vectors.join("raw.js"))?;
    for other in [&plain, &light, &small] {
        if files::read(&other.join("raw.js"))? != script {
            return Err(Failure::new("wasm-bindgen wrote different scripts for the modules"));
        }
    }
    files::write(&dir().join("raw.js"), &script)?;
    let code = no_wasm::convert(&small.join("raw_bg.wasm"), &small)?;
    let modules = [(vectors, "raw_bg.wasm"), (plain, "plain_bg.wasm"), (light, "light_bg.wasm")];
    let modules = modules.map(|(dir, name)| (dir.join("raw_bg.wasm"), name));
    for (from, name) in modules.into_iter().chain([(code, "code.js")]) {
        std::fs::copy(from, dir().join(name)).during(|| format!("writing {name}"))?;
    }
    files::copy_dir(&scripts, &dir())?;
    minify_scripts(&scripts)?;
    for license in ["LICENSE-MIT", "LICENSE-APACHE"] {
        let text = files::read(&files::root().join(license))?;
        files::write(&dir().join(license), &text)?;
    }
    write_inline_module()?;
    write_build_info()?;
    println!("the package is in dist/js");
    Ok(())
}

/// Removes comments and white space from the scripts in `dist/js` that came from `sources`: the
/// type declarations carry the documentation, and a page loads the scripts. Scripts with
/// annotations for bundlers stay as they are, because esbuild removes these too.
fn minify_scripts(sources: &Path) -> Result {
    for source in files::with_suffix(sources, ".js")? {
        let text = files::read(&source)?;
        if !["@vite-ignore", "@__PURE__"].iter().any(|annotation| text.contains(annotation)) {
            let name = source.file_name().unwrap_or_default();
            tools::minify(&source, &dir().join(name), "--minify-whitespace")?;
        }
    }
    Ok(())
}

/// The module that becomes a script.
const SMALL: &str = "small";

/// Builds a module and its binding script in `target/js/NAME`, and returns that folder.
fn module(name: &str, compile: impl Fn(&str) -> Result<PathBuf>) -> Result<PathBuf> {
    let to = files::target().join("js").join(name);
    files::create_dir(&to)?;
    // What wasm2js translates it optimises itself.
    wasm::bind(&compile("muslin-js")?, &to, "raw", name != SMALL)?;
    Ok(to)
}

/// Writes the module as base64 text in a script, for pages that load no second file.
fn write_inline_module() -> Result {
    use base64::Engine;
    let module = dir().join("raw_bg.wasm");
    let bytes = std::fs::read(&module).during(|| format!("reading {}", module.display()))?;
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    files::write(&dir().join("bytes.js"), &format!("export default \"{text}\";\n"))
}

/// Writes version, commit and compiler into `package.json` and `build.json`.
fn write_build_info() -> Result {
    let version = env!("CARGO_PKG_VERSION");
    let manifest = dir().join("package.json");
    let text = files::read(&manifest)?;
    let filled = text.replace("\"version\": \"0.0.0\"", &format!("\"version\": \"{version}\""));
    if filled == text {
        return Err(Failure::new("package.json has no version 0.0.0 to replace"));
    }
    files::write(&manifest, &filled)?;
    // An archive of the sources has no commit.
    let mut git = shell::command("git");
    git.args(["describe", "--always", "--abbrev=40", "--exclude=*", "--dirty"]);
    let commit = match git.stderr(std::process::Stdio::null()).output() {
        Ok(output) if output.status.success() => {
            format!("\"{}\"", String::from_utf8_lossy(&output.stdout).trim())
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

/// Installs the npm packages that tests use, and a copy of the package as it was last built.
pub fn install_for_tests() -> Result {
    npm::install()?;
    // A copy, as an installation is: in its own folder it finds the packages that it imports.
    let copy = npm::modules().join("muslin");
    files::once_in_run("npm-copy", || {
        files::create_empty_dir(&copy)?;
        files::copy_dir(&dir(), &copy)
    })
}
