//! Plays the scenes of `muslin-verify`, which checks the guarantees of cloth after every tick.

use crate::failure::Result;
use crate::{shell, validate};

/// The profile of the program: optimised as a user's own release build is.
const PROFILE: &str = "release-test";
/// Plays a few scenes for a few ticks.
const SHORT: &str = "--short";

/// `cargo xtask verify`: plays the scenes that are named, or all; `--short` and `--list` are passed
/// on.
pub fn run(arguments: &[String]) -> Result {
    let run = ["run", "--profile", PROFILE, "--package", "muslin-verify", "--"];
    shell::run(shell::cargo(&run).args(arguments))
}

/// Step `verify`: plays the short scenes, and a few runs of the reference cases of physics.
pub fn test_briefly() -> Result {
    run(&[SHORT.into()])?;
    validate::test()
}
