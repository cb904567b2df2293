//! Studies: sweeps of vehicle runs over many cases, one row of indices per case. The results are bit-identical for any
//! order and number of threads.

mod check;
pub mod curves;
mod digest;
mod figure_case;
mod journal;
mod merge;
mod observation;
mod observed;
mod physics;
mod plan;
mod row;
pub mod rows;
mod run;
mod shared;
mod study;
mod summary;

pub use check::{CheckError, check, choose};
pub use digest::digest_of_cells;
pub use journal::{Finished, Journal};
pub use merge::{Duplicate, Gaps, MergeError, merge};
pub use observation::Observation;
pub use observed::{OBSERVED, Observed};
pub use physics::PHYSICS;
pub use plan::{Plan, row, run, run_with};
pub use row::{ROW_DIGEST, Row, RowError, VERSION};
pub use run::{RunError, observe};
pub use shared::Shared;
pub use study::{Shard, Study, StudyCase};
pub use summary::Estimate;
