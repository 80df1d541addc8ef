//! The benchmarks.

use crate::failure::Result;
use crate::shell;

/// Runs them; options go to the harness.
pub fn run(options: &[String]) -> Result {
    let mut cargo = shell::cargo(&["bench", "--package", "muslin", "--"]);
    shell::run(cargo.args(options))
}
