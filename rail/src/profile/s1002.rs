//! The wheel profile S1002 (EN 13715) from its definition.

use super::{Profile, SAMPLE_SPACING_M};

/// Distance from the back of the flange to the tread datum, m (EN 13715).
pub const FLANGE_BACK_TO_DATUM_M: f64 = 0.070;

/// Flange-side ends of the sections A to H, mm from the tread datum.
pub const JOINTS_MM: [f64; 8] = [
    32.157_96,
    -26.0,
    -35.0,
    -38.426_669_071,
    -39.764_473_993,
    -49.662_510_381,
    -62.764_705_882,
    -70.0,
];

/// Coefficients of section B, by rising powers of the position in mm.
const B: [f64; 9] = [
    0.0,
    -3.358_537_058e-2,
    1.565_681_624e-3,
    -2.810_427_944e-5,
    5.844_240_864e-8,
    -1.562_379_023e-8,
    5.309_217_349e-15,
    -5.957_839_843e-12,
    2.646_656_573e-13,
];
/// Coefficients of section C, by rising powers of the position in mm.
const C: [f64; 8] = [
    -4.320_221_063e3,
    -1.038_384_026e3,
    -1.065_501_873e2,
    -6.051_367_875,
    -2.054_332_446e-1,
    -4.169_739_389e-3,
    -4.687_195_829e-5,
    -2.252_755_540e-7,
];

/// Depth of one section at `s_mm` from the tread datum, mm, down positive.
///
/// `section` is 0 (A) to 7 (H); larger numbers mean H as well.
pub fn section_mm(section: usize, s_mm: f64) -> f64 {
    let s = s_mm;
    let polynomial = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
    let arc = |radius: f64, centre: f64| (radius * radius - (s - centre).powi(2)).max(0.0).sqrt();
    match section {
        0 => 1.364_323_640 - 0.066_666_666_67 * s,
        1 => polynomial(&B),
        2 => polynomial(&C),
        3 => 16.446 - arc(13.0, -26.210_665),
        4 => -93.576_667_419 - 2.747_477_419 * s,
        5 => 8.834_924_130 + arc(20.0, -58.558_326_413),
        6 => 16.0 + arc(12.0, -55.0),
        _ => 9.519_259_302 + arc(20.5, -49.5),
    }
}

/// Depth at `s_mm` from the tread datum (-70 to 60 mm, field side positive), mm, down positive.
///
/// ```
/// // The flange is 28 mm high; its tip lies 55 mm from the tread datum.
/// let tip_mm = dashpot_rail::profile::s1002::depth_mm(-55.0);
/// assert!((tip_mm - 28.0).abs() < 1e-9);
/// ```
pub fn depth_mm(s_mm: f64) -> f64 {
    let section = JOINTS_MM.iter().position(|&end| s_mm > end).unwrap_or(7);
    section_mm(section, s_mm)
}

/// The profile from the back of the flange to the field side. It starts 0.05 mm from the back, because the tangent is
/// vertical at the back itself.
pub fn profile() -> Profile {
    let mut points = Vec::new();
    let mut s = -69.95;
    let slope = |s: f64| (depth_mm(s + 1e-6) - depth_mm(s - 1e-6)) / 2e-6;
    while s < 60.0 {
        points.push([s * 1e-3, depth_mm(s) * 1e-3]);
        s += 1e3 * SAMPLE_SPACING_M / libm::hypot(1.0, slope(s));
    }
    points.push([60e-3, depth_mm(60.0) * 1e-3]);
    Profile::resampled("S1002", &points, 0.0)
}
