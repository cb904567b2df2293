//! Developer commands of Dashpot.
fn main() {}
