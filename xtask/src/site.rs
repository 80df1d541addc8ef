//! Builds the site into `dist/site`, serves it, and tests it in a browser.
//!
//! `docs/site` holds its sources. They are copied to `target/site`, where npm installs what builds
//! them: VitePress and the tools that write the references from the header and the type
//! declarations.

use std::path::{Path, PathBuf};

use crate::browser::ServerProcess;
use crate::failure::{During, Failure, Result};
use crate::serve::{Mount, Server};
use crate::setup::Need;
use crate::{browser, clients, files, npm, picture, setup, shell, web};

/// What building the site needs.
pub const NEEDS: &[&Need] = &[&setup::NODE, &setup::PYTHON_VENV, &setup::CHROMIUM];

/// What a host's header would add to the policies that the pages bring themselves.
const POLICY: &str = "frame-ancestors 'self'";

/// The folder that the site is built in.
fn dir() -> PathBuf {
    files::root().join("dist/site")
}

/// `cargo xtask site`: builds the site, with `--base` for the folder of the host that it will be
/// served from, or serves it with `--serve`.
pub fn run(options: &[String]) -> Result {
    let typed: Vec<_> = options.iter().flat_map(|option| option.splitn(2, '=')).collect();
    match typed[..] {
        [] => build("/"),
        ["--base", base] if is_base(base) => build(base),
        ["--serve"] => serve(None),
        ["--serve", "--port", port] => {
            let number = port.parse().map_err(|_| Failure::new("--port must be 0 to 65535"))?;
            serve(Some(number))
        }
        _ => Err(Failure::new(
            "`cargo xtask site` takes --base, such as /cloth/ with both slashes, or --serve with \
             --port",
        )),
    }
}

fn is_base(base: &str) -> bool {
    let is_plain = |sign: char| sign.is_ascii_alphanumeric() || "/-_.".contains(sign);
    base.starts_with('/') && base.ends_with('/') && base.chars().all(is_plain)
}

/// Builds everything that the site shows, then the site.
fn build(base: &str) -> Result {
    setup::ensure(NEEDS)?;
    clients::pack_for_tests()?;
    web::build()?;
    let rustdoc = build_rust_reference()?;
    let work = copy_sources()?;
    npm::install_in(&work)?;
    install_package(&work)?;
    write_python_reference(&work)?;
    let mut node = shell::command("node");
    node.current_dir(&work).arg("build/build.mjs");
    shell::run(node.arg(files::root()).arg(dir()).arg(base).arg(rustdoc))
}

/// Writes the reference of the crate into a folder of its own: step `clippy` writes one with
/// private items into the usual folder.
fn build_rust_reference() -> Result<PathBuf> {
    let target = files::target().join("site-doc");
    let mut doc = shell::cargo(&["doc", "--no-deps", "--package=muslin", "--lib"]);
    shell::run(doc.arg("--target-dir").arg(&target))?;
    Ok(target.join("doc"))
}

/// Copies `docs/site`, and keeps the packages that are installed in the copy.
fn copy_sources() -> Result<PathBuf> {
    let work = files::target().join("site");
    files::create_dir(&work)?;
    for path in files::list(&work)? {
        let name = path.file_name().unwrap_or_default();
        let during = || format!("removing {}", path.display());
        if path.is_file() {
            std::fs::remove_file(&path).during(during)?;
        } else if name != "node_modules" {
            std::fs::remove_dir_all(&path).during(during)?;
        }
    }
    files::copy_dir(&files::root().join("docs/site"), &work)?;
    let poster = files::root().join("demo/web/share-sheet.jpg");
    std::fs::copy(poster, work.join("poster.jpg")).during(|| "copying the poster".into())?;
    Ok(work)
}

/// Installs the packed npm package beside the others.
fn install_package(work: &Path) -> Result {
    let installed = work.join("node_modules/muslin");
    if installed.exists() {
        std::fs::remove_dir_all(&installed).during(|| "removing the last package".into())?;
    }
    let mut install = shell::command("npm");
    install.current_dir(work).args(["install", "--no-save", "--offline", "--ignore-scripts"]);
    shell::run(install.args(["--no-audit", "--no-fund"]).arg(clients::tarball()))
}

/// Writes the reference of the Python package from its sources, with Griffe in an environment of
/// its own.
fn write_python_reference(work: &Path) -> Result {
    let environment = files::target().join("site-python");
    let bin = environment.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let wanted = work.join("requirements.txt");
    let installed = environment.join("requirements.txt");
    if files::read(&installed).ok() != Some(files::read(&wanted)?) {
        files::create_empty_dir(&environment)?;
        shell::run(shell::command("python3").args(["-m", "venv"]).arg(&environment))?;
        let mut pip = shell::command(bin.join("python"));
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        shell::run(pip.arg("--requirement").arg(&wanted))?;
        std::fs::copy(&wanted, &installed).during(|| "copying requirements.txt".into())?;
    }
    let mut python = shell::command(bin.join("python"));
    python.arg(work.join("build/python.py")).arg(files::root().join("bindings/python/src"));
    shell::run(python.arg(work.join("api/python")))
}

fn serve(port: Option<u16>) -> Result {
    build("/")?;
    let server = match port {
        Some(port) => Server::open(vec![Mount { at: "/", dir: dir() }], port)?,
        None => Server::open_anywhere(&dir())?,
    };
    let server = server.with_policy(POLICY);
    println!("serving {} (Ctrl-C stops)", server.url());
    server.run();
    Ok(())
}

/// Builds the site, serves it with `cargo xtask site --serve` and tests it in a browser.
pub fn test() -> Result {
    let server = ServerProcess::start(&["site", "--serve", "--port", "0"])?;
    let shots = files::target().join("shots/site");
    files::create_empty_dir(&shots)?;
    // axe-core is one of the packages that the site is built with.
    let modules = files::target().join("site/node_modules");
    let paths =
        [("MUSLIN_SHOTS", &shots), ("MUSLIN_SITE", &dir()), ("MUSLIN_SITE_MODULES", &modules)];
    browser::node_test("tests/web/site.test.mjs", &server.url, &paths)?;
    browser::node_test("tests/web/playground.test.mjs", &server.url, &[])?;
    picture::check(&shots.join("landing-1440-dark.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_without_both_slashes_is_refused() {
        assert!(is_base("/") && is_base("/cloth/") && !is_base("cloth/") && !is_base("/a b/"));
        for options in [&["--base", "/cloth"][..], &["--base"], &["--serve", "--port", "x"]] {
            let options: Vec<_> = options.iter().map(|option| String::from(*option)).collect();
            assert!(run(&options).is_err_and(|failure| failure.to_string().contains("--")));
        }
    }
}
