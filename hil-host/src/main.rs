//! The `dashpot` command.
fn main() {}
