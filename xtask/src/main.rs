//! Every chore of Muslin as one command.
fn main() {}
