//! `dashpot vehicle --check`.

use crate::commands::arguments::Format;
use crate::commands::failure::{Failure, Outcome};
use crate::files::case::Case;

pub(super) fn run(_: &Case, _: Format) -> Outcome<()> {
    Err(Failure::new("not yet"))
}
