//! Plays the scenes of `muslin-verify`, which checks the guarantees of cloth after every tick.

use crate::bits;
use crate::failure::Result;
use crate::shell;

/// `cargo xtask verify`: plays the scenes that are named, or all; `--short` and `--list` are passed
/// on.
pub fn run(arguments: &[String]) -> Result {
    let run = ["run", "--package", "muslin-verify"];
    shell::run(bits::cargo(&run).arg("--").args(arguments))
}

/// Step `verify`: plays the short scenes, and a few runs of the reference cases of physics.
pub fn test_briefly() -> Result {
    let features = "--features=muslin-verify/brief,muslin-validate/brief";
    let packages = ["--package=muslin-verify", "--package=muslin-validate"];
    let mut cargo = bits::cargo_test(&["--test=brief"]);
    shell::run(cargo.args(packages).arg(features))
}
