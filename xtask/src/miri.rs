//! Runs the boundary of the C library under Miri, which detects undefined behaviour.

use crate::failure::{Failure, Result};
use crate::{files, setup, shell};

/// Miri comes with nightly toolchains only.
const NIGHTLY: &str = "nightly";

/// Runs the unit tests of handles and of calls that read or write through pointers; takes some
/// minutes.
pub fn run(options: &[String]) -> Result {
    if !options.is_empty() {
        return Err(Failure::new("`cargo xtask miri` takes no options"));
    }
    let components = ["component", "add", "--toolchain", NIGHTLY, "miri", "rust-src"];
    setup::rustup("Miri is missing", &components)?;
    let mut miri = shell::command("rustup");
    miri.args(["run", NIGHTLY, "cargo", "miri", "test", "--package=muslin-c", "--lib"]);
    // Statistics read the real clock.
    miri.env("MIRIFLAGS", "-Zmiri-disable-isolation");
    shell::run(miri.env("CARGO_TARGET_DIR", files::target().join("miri")))
}
