//! Trends of the dampers of a fleet over months of recordings: rates of change, and when limits are reached.
//!
//! [`recordings::list`] finds the recordings, [`series::series`] sorts them by damper, [`series::estimate`] runs the
//! health estimator over each, and [`Fleet::assess`] fits a line to each parameter of each damper.

pub mod axis;
mod exchange;
pub mod fit;
pub mod fleet;
pub mod forecast;
pub mod limits;
pub mod parameter;
pub mod reading;
pub mod recordings;
pub mod rows;
pub mod series;
pub mod summary;
mod table;
pub mod words;

pub use axis::Axis;
pub use fleet::{DamperTrends, Fleet, Trend};
pub use parameter::Parameter;
pub use summary::Summary;
