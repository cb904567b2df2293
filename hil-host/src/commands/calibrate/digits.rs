//! Numbers of a calibration as text.

/// Formats a number with four significant digits.
pub(super) fn digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (0.01..10_000.0).contains(&size) {
        let decimals = 3 - size.log10().floor().clamp(-2.0, 3.0) as i32;
        format!(
            "{value:.*}",
            if value == 0.0 { 0 } else { decimals as usize }
        )
    } else {
        format!("{value:.3e}")
    }
}
