//! The tests of the Rust code: format, lints, tests, and the short checks for work on the library.

use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::{files, setup, shell, wasm};

/// A part of `cargo xtask check`: its name, and what runs it.
pub type Check = (&'static str, fn() -> Result);

/// The parts of `cargo xtask check`.
pub const CHECKS: [Check; 4] = [
    ("fmt", check_format),
    ("clippy", lint_library),
    ("unit tests", test_units),
    ("closed forms", test_closed_forms),
];

/// What turns every warning into an error.
const DENY_WARNINGS: [&str; 3] = ["--", "-D", "warnings"];

/// Fails where a file is formatted otherwise than rustfmt would.
pub fn check_format() -> Result {
    setup::ensure_component("fmt", "rustfmt")?;
    shell::run(&mut shell::cargo(&["fmt", "--all", "--check"]))?;
    // What is built for engines is a workspace of its own, so that nobody else resolves their crates.
    ["bevy", "godot"].iter().try_for_each(|engine| {
        let manifest = format!("--manifest-path=bindings/{engine}/Cargo.toml");
        shell::run(&mut shell::cargo(&["fmt", &manifest, "--check"]))
    })
}

/// Fails where clippy warns (in all crates, and in what is compiled for pages), where the compiler warns
/// without optional parts, and where the documentation has a defect.
///
/// Lints have a folder of their own: what they compile helps no build, and step `rust` locks
/// `target/debug` for minutes.
pub fn lint() -> Result {
    setup::ensure_component("clippy", "clippy")?;
    setup::ensure_target(wasm::TARGET)?;
    let all = ["clippy", "--workspace", "--all-targets", "--features=muslin-golden/parallel"];
    shell::run(lint_cargo(&all).args(DENY_WARNINGS))?;
    let mut web = lint_cargo(&["clippy", "--lib", "--target", wasm::TARGET]);
    web.args(["muslin-js", "muslin-demo", "muslin-plain"].map(|name| format!("--package={name}")));
    shell::run(web.args(DENY_WARNINGS))?;
    check_features()?;
    check_docs()
}

/// Cargo that builds in the folder of lints.
fn lint_cargo(args: &[&str]) -> Command {
    let mut cargo = shell::cargo(args);
    cargo.env("CARGO_TARGET_DIR", files::target().join("lint"));
    cargo
}

/// The features of the crate that can be left out.
const PARTS: [&str; 7] =
    ["cut", "facet-colliders", "save", "self-collision", "sewing", "shared-rest", "skins"];

/// Fails where clippy warns without any of the parts or in the module of `muslin/light`, or where the
/// compiler warns without one of the parts. Each line of code is in a build that clippy reads.
fn check_features() -> Result {
    let none = ["clippy", "--package=muslin", "--lib", "--no-default-features"];
    shell::run(lint_cargo(&none).args(DENY_WARNINGS))?;
    let light = ["clippy", "--lib", "--package=muslin-js", "--no-default-features", "--target"];
    shell::run(lint_cargo(&light).arg(wasm::TARGET).args(DENY_WARNINGS))?;
    PARTS.iter().try_for_each(|left_out| {
        let kept: Vec<_> = PARTS.into_iter().filter(|part| part != left_out).collect();
        let mut check = lint_cargo(&["rustc", "--profile=check", "--package=muslin", "--lib"]);
        check.args(["--no-default-features", &format!("--features={}", kept.join(","))]);
        shell::run(check.args(DENY_WARNINGS))
    })
}

/// What looks like a link in a doc comment and is a unit.
const UNITS: [&str; 13] =
    ["m", "m²", "m³", "m⁴", "s", "rad", "kg", "N", "Pa", "J", "bytes", "spacings", "gaps"];

/// Fails where the documentation of the library has a broken link or another defect.
fn check_docs() -> Result {
    let mut doc = lint_cargo(&["doc", "--no-deps", "--package=muslin", "--all-features"]);
    doc.arg("--document-private-items");
    doc.env("RUSTDOCFLAGS", "-W rustdoc::broken_intra_doc_links");
    let done = doc.output().during(|| "starting cargo doc".into())?;
    let text = String::from_utf8_lossy(&done.stderr);
    let is_unit = |line: &str| {
        let link = line.strip_prefix("warning: unresolved link to `");
        link.is_some_and(|link| UNITS.contains(&link.trim_end_matches('`')))
    };
    let is_defect = |line: &&str| {
        line.starts_with("warning: ") && !line.contains("generated") && !is_unit(line)
    };
    let defects: Vec<_> = text.lines().filter(is_defect).collect();
    if done.status.success() && defects.is_empty() {
        return Ok(());
    }
    let shown = if done.status.success() { String::new() } else { format!("\n{text}") };
    Err(Failure::new(format!("cargo doc reports: {}{shown}", defects.join("; "))))
}

/// Runs all tests and examples of all crates.
///
/// Cargo unites the features of the packages that it builds together. So several builds are quicker
/// than one: `xtask` has been built with its own features, the documents show `--package muslin`,
/// and `muslin-js`, which has no Rust tests, would change the features of what all others use.
/// `muslin-features` has the crate without its optional parts. Step `bits` runs the tests of `muslin-golden`.
pub fn test() -> Result {
    shell::run(&mut cargo_test(&["--package=muslin"]))?;
    shell::run(&mut cargo_test(&["--package=xtask"]))?;
    let others = ["muslin", "xtask", "muslin-js", "muslin-features", "muslin-golden"];
    let others = others.map(|package| format!("--exclude={package}"));
    shell::run(cargo_test(&["--workspace"]).args(others))?;
    // Without optimisation: the tests are short, and no other build has these features.
    let quick = ["--config", "profile.dev.package.muslin.opt-level=0"];
    shell::run(cargo_test(&["--package=muslin-features"]).args(quick))
}

fn lint_library() -> Result {
    setup::ensure_component("clippy", "clippy")?;
    shell::run(shell::cargo(&["clippy", "--package=muslin", "--lib"]).args(DENY_WARNINGS))
}

fn test_units() -> Result {
    shell::run(&mut cargo_test(&["--package=muslin", "--lib"]))
}

fn test_closed_forms() -> Result {
    let words = ["--package=muslin", "--test=physics", "--", "closed_forms"];
    shell::run(&mut cargo_test(&words))
}

/// `cargo test`, for which a snapshot that differs is a failure and never a new snapshot.
fn cargo_test(words: &[&str]) -> Command {
    let mut cargo = shell::cargo(&["test"]);
    cargo.args(words).env("INSTA_UPDATE", "no");
    cargo
}
