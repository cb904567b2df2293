//! Extended studies: rows of a study are kept when it gets more seeds, values, sweeps or indices.
//!
//! Beside `rows.csv` is `rows.study`, which has the outline of the study and all indices of each case. Rows of an
//! earlier study are used only if the cases of its outline, built from the files of today, have its digest.

mod differences;
mod kept;
mod merged;
mod moved;
mod outline;
mod parts;

pub use kept::{Kept, path_of};
pub use merged::write_merged;
pub use moved::{Moved, NotAnExtension, read_rows};
pub(super) use outline::Outline;
