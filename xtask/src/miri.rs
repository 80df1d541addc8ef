//! The boundary of the C library under Miri, which sees whatever Rust does not allow.

use crate::failure::{Failure, Result};
use crate::{files, setup, shell};

/// Rust with Miri is a nightly one.
const NIGHTLY: &str = "nightly";

/// Runs the tests of the boundary: of handles, and of calls that follow pointers; some minutes.
pub fn run(options: &[String]) -> Result {
    if !options.is_empty() {
        return Err(Failure::new("`cargo xtask miri` takes no options"));
    }
    let components = ["component", "add", "--toolchain", NIGHTLY, "miri", "rust-src"];
    setup::rustup("Miri is missing", &components)?;
    let mut miri = shell::command("rustup");
    miri.args(["run", NIGHTLY, "cargo", "miri", "test", "--package=muslin-c", "--lib"]);
    // What a tick costs is told by a real clock.
    miri.env("MIRIFLAGS", "-Zmiri-disable-isolation");
    shell::run(miri.env("CARGO_TARGET_DIR", files::target().join("miri")))
}
