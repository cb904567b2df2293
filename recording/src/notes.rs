//! What a user should know about rows that were read without an error.

use serde::Serialize;

/// End of the rows of an MDF4 file that its logger did not finish, because it crashed or lost power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct UnfinishedEnd {
    /// Bytes after the last whole row that are not read.
    pub left_bytes: u64,
}

/// How a force from another group was brought to the times of the displacement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interpolation {
    /// Number of the group of the displacement, from 1.
    pub displacement_group: usize,
    /// Number of the group of the force, from 1.
    pub force_group: usize,
    /// Rows of the displacement that were omitted because they are before the first or after the last force.
    pub outside: u64,
    /// Samples of the force that were omitted because they or their times are missing.
    pub left_out: u64,
    /// Longest interval between two samples of the force across which a value was interpolated (s).
    pub longest_interval_s: Option<f64>,
}
