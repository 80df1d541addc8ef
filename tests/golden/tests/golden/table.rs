//! The table of golden hashes.

/// The text of `golden.txt`.
pub const GOLDEN: &str = include_str!("../../golden.txt");

#[test]
fn every_scene_ends_in_its_golden_hash() {
    let table = muslin_golden::table(false);
    assert!(
        table == GOLDEN,
        "golden.txt says\n{GOLDEN}\nbut the scenes end in\n{table}\n\
         A new hash is a new simulation: say why in CHANGELOG.md, then accept it with\n\
         cargo xtask bits --bless"
    );
}
