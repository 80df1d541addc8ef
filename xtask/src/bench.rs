//! The benchmarks: tables of kernels and whole ticks.

use crate::failure::Result;
use crate::shell;

/// Prints the tables that are named, or all; `--test` runs everything once and tiny.
pub fn run(options: &[String]) -> Result {
    let mut cargo = shell::cargo(&["bench", "--package", "muslin", "--bench", "tables", "--"]);
    shell::run(cargo.args(options.iter().filter(|option| *option != "--")))
}
