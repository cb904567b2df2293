//! Time spans as text.

/// Formats a span (ns) to three significant digits, in the unit that leaves one to three digits before the point.
///
/// ```
/// use dashpot_realtime::timing::span;
/// assert_eq!(span(67.24), "67.2 ns");
/// assert_eq!(span(1_350.0), "1.35 us");
/// assert_eq!(span(999_900.0), "1.00 ms");
/// assert_eq!(span(0.0), "0.00 ns");
/// ```
pub fn span(span_ns: f64) -> String {
    // From this value on, rounding to three digits gives four digits before the point, so the next unit is used.
    const NEXT: f64 = 999.5;
    let mut value = span_ns;
    let mut unit = "ns";
    for larger in ["us", "ms", "s"] {
        if value < NEXT {
            break;
        }
        value *= 1e-3;
        unit = larger;
    }
    let digits = match value {
        small if small < 9.995 => 2,
        medium if medium < 99.95 => 1,
        _ => 0,
    };
    format!("{value:.digits$} {unit}")
}

/// Formats an optional span; `-` for `None`.
pub fn optional_span(span_ns: Option<f64>) -> String {
    span_ns.map_or_else(|| "-".into(), span)
}
