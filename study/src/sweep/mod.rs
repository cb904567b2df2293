//! Studies: sweeps of vehicle runs over many cases, one row of indices per case. The results are bit-identical for any
//! order and number of threads.

mod check;
mod contact_tables;
pub mod curves;
mod digest;
mod done;
mod estimate;
mod even_track;
pub mod extension;
mod figure_case;
mod journal;
mod lock;
mod merge;
mod observation;
mod observed;
mod pairs;
mod physics;
mod plan;
mod row;
pub mod rows;
mod run;
mod shared;
mod study;
mod summary;

pub use check::{CheckError, check, choose};
pub use contact_tables::{ContactTables, ContactTablesError, TablesFile};
pub use digest::digest_of_cells;
pub use done::rows_done;
pub use estimate::{PROBE, TimeEstimate};
pub use even_track::even_track;
pub use journal::{Finished, Journal, Start};
pub use merge::{Duplicate, Gaps, MergeError, merge};
pub use observation::Observation;
pub use observed::{IndexValues, OBSERVED, Observed};
pub use physics::PHYSICS;
pub use plan::{Computed, Plan, row, run, run_with};
pub use row::{ROW_DIGEST, Row, RowError, VERSION};
pub use run::{RunError, observe};
pub use shared::Shared;
pub use study::{Shard, Study, StudyCase};
pub use summary::Estimate;
