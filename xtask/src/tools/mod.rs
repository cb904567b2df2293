//! Programs that developer commands and tests run: a list of them, their installation, and the tests that are skipped
//! without them.

mod apt;
mod program;
mod skip;
mod subcommand;

pub use apt::install;
pub use program::*;
pub use skip::{SKIPPED, have, have_library, have_target, skip};
pub use subcommand::{
    CARGO_ABOUT, CARGO_DENY, CARGO_FUZZ, CARGO_HACK, CARGO_MUTANTS, CARGO_SEMVER_CHECKS, Subcommand,
};
