//! The reference cases within their tolerances, as an optimised build plays them.

use std::process::Command;

#[test]
fn the_reference_cases_are_as_close_as_before() {
    let program = env!("CARGO_BIN_EXE_muslin-validate");
    let status = Command::new(program).arg("--test").status().expect("muslin-validate runs");
    assert!(status.success(), "a reference case is farther off than before");
}
