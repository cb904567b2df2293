//! Limits of what is evaluated.

/// Lowest rate of readings (Hz): a hundred, less the error of a logger's clock.
pub(super) const MIN_RATE_HZ: f64 = 99.0;
/// Shortest duration of a recording (s): settling, ramps and a few seconds of ride.
pub(super) const MIN_DURATION_S: f64 = 10.0;
/// Minimum number of seconds of ride.
pub(super) const MIN_SECONDS: usize = 12;
/// Seconds of ride beyond the number of factors.
pub(super) const MIN_SPARE_SECONDS: usize = 4;
/// Largest unexplained share of a baseline, and of a ride that is compared with it.
pub const MAX_UNEXPLAINED: f64 = 0.03;
