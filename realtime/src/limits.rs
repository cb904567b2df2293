//! Limits of real-time runs.

use std::ops::RangeInclusive;

/// Range of tick rates for paced runs (Hz).
pub const RATE_RANGE_HZ: RangeInclusive<u32> = 1000..=10_000;

/// One tick in this many may miss its deadline.
pub const TICKS_PER_ALLOWED_MISS: u64 = 1000;
