//! Deflection of two elastic half-spaces under strips of load.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::sync::OnceLock;

use super::octave_table::OctaveTable;
use crate::math::elliptic::complete;

/// Midpoints for the mean deflection of a strip under its own load.
const MIDPOINTS: usize = 16;

/// Tables of the deflection, the same for every steel.
///
/// A strip is a line across the rolling direction with the pressure `p0 sqrt(1 - (x/a)^2)`. Under its load per width
/// `q = pi/2 a p0`, the half-spaces deflect at the distance `t` beside its middle by `q G(t/a) / (pi E* a)`, with
/// `G(u) = 4/pi sqrt(1 + u^2) (K - E)` at the modulus `1/sqrt(1 + u^2)` (integral of Boussinesq's solution, Johnson,
/// Contact Mechanics, 1985, 3.19).
#[derive(Debug)]
pub(super) struct HalfSpace {
    beside: OctaveTable,
    own: OctaveTable,
    length: OctaveTable,
}

impl HalfSpace {
    /// The tables, computed once.
    pub fn tables() -> &'static Self {
        static TABLES: OnceLock<HalfSpace> = OnceLock::new();
        TABLES.get_or_init(|| Self {
            beside: OctaveTable::new([-10, 10], beside),
            own: OctaveTable::new([-10, 10], |width| {
                // The points crowd towards the middle, where the deflection is infinite as a logarithm is.
                let at = |k: usize| (k as f64 + 0.5) / MIDPOINTS as f64;
                let terms =
                    (0..MIDPOINTS).map(|k| 2.0 * at(k) * beside(0.5 * width * at(k).powi(2)));
                terms.sum::<f64>() / MIDPOINTS as f64
            }),
            length: OctaveTable::new([-10, 10], |ratio| {
                // Solves ratio = k / sqrt(F(k)) for k; F changes slowly.
                let mut k = ratio;
                for _ in 0..60 {
                    k = ratio * pressure_rise(k).sqrt();
                }
                pressure_rise(k)
            }),
        })
    }

    /// `G(t/a)`: deflection beside a strip, divided by `q / (pi E* a)`.
    #[inline]
    pub fn beside(&self, distance: f64) -> f64 {
        self.beside.at(distance)
    }

    /// Mean of `G` over the width of the strip, in half-lengths `a`.
    #[inline]
    pub fn own(&self, width: f64) -> f64 {
        self.own.at(width)
    }

    /// Squared half-length of the strips of an elliptical patch, divided by `4 R q / (pi E*)`, with the radius `R` in
    /// the rolling direction. `ratio` is `sqrt(4 R q0 / (pi E*)) / b` with `q0` in the middle and the semi-axis `b`.
    #[inline]
    pub fn squared_length(&self, ratio: f64) -> f64 {
        self.length.at(ratio)
    }
}

/// `G(u)`.
fn beside(u: f64) -> f64 {
    let root = libm::hypot(u, 1.0);
    let (first, second) = complete(u / root);
    4.0 / PI * root * (first - second)
}

/// `F(k)` with the ratio `k = a/b` of the semi-axes: the pressure in the middle of an ellipse is
/// `E* a / (2 R F)` (Johnson 1985, 4.26).
fn pressure_rise(k: f64) -> f64 {
    if (k - 1.0).abs() < 1e-4 {
        return FRAC_PI_4;
    }
    if k < 1.0 {
        let (first, second) = complete(k);
        return (second - k * k * first) / (1.0 - k * k);
    }
    let (first, second) = complete(1.0 / k);
    (first - second) * k / (k * k - 1.0)
}

/// Peak pressure of a strip, `p0 = q / (pi/2 a)`.
pub(super) fn peak_pressure(line_load: f64, half_length: f64) -> f64 {
    line_load / (FRAC_PI_2 * half_length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_away_a_strip_is_a_point_load() {
        for u in [20.0, 100.0, 900.0] {
            let beside = HalfSpace::tables().beside(u);
            assert!((beside * u - 1.0).abs() < 1e-3, "{u}");
        }
    }

    #[test]
    fn near_by_a_strip_is_a_line_load() {
        // 4/pi (ln(4/u) - 1), and its mean over a width.
        for u in [0.002_f64, 0.01] {
            let line = 4.0 / PI * ((4.0 / u).ln() - 1.0);
            let beside = HalfSpace::tables().beside(u);
            assert!((beside / line - 1.0).abs() < 1e-3, "{u}");
            let (mean, own) = (4.0 / PI * (8.0 / u).ln(), HalfSpace::tables().own(u));
            assert!((own / mean - 1.0).abs() < 1e-3, "{u}");
        }
    }

    #[test]
    fn a_circle_and_a_cylinder_have_hertzs_pressure() {
        // Circle: a = pi p0 R / (2 E*). Cylinder: p0 = E* a / (2 R).
        assert!((pressure_rise(1.0 + 1e-3) - FRAC_PI_4).abs() < 1e-3);
        assert!((pressure_rise(1e-3) - 1.0).abs() < 1e-3);
        assert!((HalfSpace::tables().squared_length(1e-3) - 1.0).abs() < 1e-3);
    }
}
