//! Compares runs of vehicles with runs of other codes, in docs/other-codes.md.
//!
//! `DASHPOT_BLESS=1 cargo test -p dashpot --test other_codes` writes the table, the figure, and the inputs for the
//! other code. After a change of the inputs, the other code has to run again: `data/published/orvd/README.md` states
//! how.

mod comparison;
mod figure;
mod histories;
mod inputs;

/// Folder of the inputs and results of ORVD.
const FOLDER: &str = "data/published/orvd";
