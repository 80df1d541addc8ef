//! The demo of Muslin.
fn main() {}
