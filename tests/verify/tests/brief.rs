//! The short scenes, as an optimised build plays them.

use std::process::Command;

#[test]
fn the_short_scenes_hold_all_guarantees() {
    let program = env!("CARGO_BIN_EXE_muslin-verify");
    let status = Command::new(program).arg("--short").status().expect("muslin-verify runs");
    assert!(status.success(), "a guarantee of a scene does not hold");
}
