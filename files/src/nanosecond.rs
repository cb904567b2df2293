//! Rounding of times for output.

/// Rounds a time (s) to the nearest nanosecond, which removes the rounding errors of a sum of steps. From 100 days on,
/// where an `f64` cannot resolve nanoseconds, it rounds to the nearest microsecond.
pub fn nearest_nanosecond(time_s: f64) -> f64 {
    let per_s = if time_s.abs() < 8.64e6 { 1e9 } else { 1e6 };
    (time_s * per_s).round() / per_s
}
