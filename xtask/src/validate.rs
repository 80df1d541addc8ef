//! Plays the reference cases of `muslin-validate`: what the equations of physics give, and what the
//! simulation gives.

use crate::failure::{During, Failure, Result};
use crate::{bits, files, shell};

/// Leaves out what differs between machines.
const MANUAL: &str = "--manual";
/// Writes the results into the manual.
const WRITE: &str = "--write";

/// The page with the results, and the heading before them.
const PAGE: &str = "docs/manual/validation.md";
const HEADING: &str = "## Results\n";

/// `cargo xtask validate`: plays the cases that are named, or all but the slow one.
pub fn run(arguments: &[String]) -> Result {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        [WRITE] => write_page(),
        words if words.contains(&WRITE) => Err(Failure::new(format!(
            "{WRITE} plays all cases; it takes no names or other options"
        ))),
        words => shell::run(&mut program(words)),
    }
}

fn program(arguments: &[&str]) -> std::process::Command {
    let mut cargo = bits::cargo(&["run", "--quiet", "--package", "muslin-validate"]);
    cargo.arg("--").args(arguments);
    cargo
}

/// Plays all cases and replaces the results in the manual.
fn write_page() -> Result {
    let path = files::root().join(PAGE);
    let page = std::fs::read_to_string(&path).during(|| format!("reading {PAGE}"))?;
    let Some((head, _)) = page.split_once(HEADING) else {
        return Err(Failure::new(format!("{PAGE} has no line {HEADING:?}")));
    };
    let results = shell::output(&mut program(&[MANUAL]))?;
    let text = format!("{head}{HEADING}\n{}\n", results.trim_end());
    std::fs::write(&path, text).during(|| format!("writing {PAGE}"))
}
