//! Numbers rounded for text, and counts.

/// Formats a number with up to six digits, without trailing zeros.
///
/// ```
/// assert_eq!(dashpot_report::rounded::six_digits(1.0 / 3.0), "0.333333");
/// ```
pub fn six_digits(number: f64) -> String {
    digits(number, 5)
}

/// Formats a number with up to two digits, without trailing zeros.
pub fn two_digits(number: f64) -> String {
    digits(number, 1)
}

/// Formats a number with up to `digits` digits after the first, without trailing zeros.
fn digits(number: f64, digits: usize) -> String {
    let text = format!("{number:.digits$e}");
    match text.parse::<f64>() {
        Ok(rounded) if rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs()) => {
            rounded.to_string()
        }
        Ok(rounded) => format!("{rounded:e}"),
        Err(_) => text,
    }
}

/// Formats a count with its noun.
///
/// ```
/// assert_eq!(dashpot_report::rounded::counted(2, "tick"), "2 ticks");
/// ```
pub fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Converts a step (s) back to microseconds as the user wrote them.
///
/// ```
/// assert_eq!(dashpot_report::rounded::microseconds(333e-6), 333.0);
/// ```
pub fn microseconds(step_s: f64) -> f64 {
    // Round to the picosecond to remove the rounding error of the product.
    (step_s * 1e12).round() / 1e6
}
