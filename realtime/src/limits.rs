//! Limits of real-time runs.

use std::ops::RangeInclusive;

/// Rates that ticks can be paced at (Hz).
pub const RATE_RANGE_HZ: RangeInclusive<u32> = 1000..=10_000;

/// Ticks of which one may miss its deadline.
pub const TICKS_PER_ALLOWED_MISS: u64 = 1000;
