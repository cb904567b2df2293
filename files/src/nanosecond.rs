//! Times as they are printed.

/// The nearest nanosecond (s), free of the rounding of sums; the nearest microsecond from 100 days on,
/// where a clock's time in `f64` has no nanoseconds.
pub fn nearest_nanosecond(time_s: f64) -> f64 {
    let per_s = if time_s.abs() < 8.64e6 { 1e9 } else { 1e6 };
    (time_s * per_s).round() / per_s
}
