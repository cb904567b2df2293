//! Fits geometries to a given correction factor Ce.

use super::{PlateError, PressureArea, Profile, Resolution, RoundBosses, Stack};

/// Maximum number of iterations; ten usually suffice.
const MAX_ITERATIONS: u32 = 60;
/// Width of the interval at which the search ends (1).
const INTERVAL_TOLERANCE: f64 = 1e-13;
/// Error of the factor at which the search ends; rounding prevents a smaller one.
const FACTOR_TOLERANCE: f64 = 1e-9;

/// Returns the radius r_f (m) at which a pressure that is full from the clamp begins its decay,
/// `((r_w - r)/(r_w - r_f))^n`, for the correction factor `factor`.
///
/// # Errors
/// Returns an error if no radius has this correction factor.
pub fn fitted_full_radius_m(
    stack: &Stack,
    exponent: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let width = free - clamp;
    fitted("radius of full pressure", factor, [1e-3, 1.0], |share| {
        let full = clamp + share * width;
        let area = PressureArea::Ring(Profile {
            full_m: [clamp, full],
            ends_m: [clamp, free],
            exponent,
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|share| clamp + share * width)
}

/// Returns the width (m) over which a pressure that is full in the middle decays to zero at clamp and edge, for the
/// correction factor `factor`.
///
/// # Errors
/// Returns an error if no width has this correction factor.
pub fn fitted_decay_width_m(
    stack: &Stack,
    exponent: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let max_width = 0.5 * (free - clamp);
    fitted("width of decay", factor, [1e-3, 1.0], |share| {
        let width = (1.0 - share) * max_width;
        let area = PressureArea::Ring(Profile {
            full_m: [clamp + width, free - width],
            ends_m: [clamp, free],
            exponent,
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|share| (1.0 - share) * max_width)
}

/// Returns the share of the circumference that sectors with a radial profile cover, for the correction factor `factor`.
///
/// The factor is the share times the factor of the full ring, because only the harmonic of order zero has a mean.
///
/// # Errors
/// Returns an error if the correction factor of the full ring is too small.
pub fn fitted_share(
    stack: &Stack,
    profile: Profile,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let ring = stack.correction_factor(&PressureArea::Ring(profile), resolution)?;
    if !(0.0 < factor && factor <= ring) {
        return Err(PlateError::OutOfReach {
            geometry: "share of the circumference",
            factor,
            min: 0.0,
            max: ring,
        });
    }
    Ok(factor / ring)
}

/// Returns the radius (m) of round bosses for the correction factor `factor`; the hole has `hole_share` of this radius.
///
/// # Errors
/// Returns an error if no radius has this correction factor, from nearly zero to where the bosses meet the clamp, the
/// edge or each other.
pub fn fitted_boss_radius_m(
    stack: &Stack,
    bosses: RoundBosses,
    hole_share: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let max_radius = bosses.max_radius_m(stack.clamp_radius_m(), stack.free_radius_m());
    fitted("boss radius", factor, [1e-3, 1.0], |share| {
        let boss_radius_m = share * max_radius;
        let area = PressureArea::Round(RoundBosses {
            boss_radius_m,
            hole_radius_m: hole_share * boss_radius_m,
            ..bosses
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|share| share * max_radius)
}

/// Solves `evaluate(x) = factor` in an interval in which `evaluate` rises.
fn fitted(
    geometry: &'static str,
    factor: f64,
    [mut low, mut high]: [f64; 2],
    evaluate: impl Fn(f64) -> Result<f64, PlateError>,
) -> Result<f64, PlateError> {
    let (min, max) = (evaluate(low)?, evaluate(high)?);
    if !(min..=max).contains(&factor) {
        return Err(PlateError::OutOfReach {
            geometry,
            factor,
            min,
            max,
        });
    }
    // Regula falsi, Illinois variant: if an end is kept twice in a row, its value is halved.
    let (mut at_low, mut at_high) = (min - factor, max - factor);
    let mut low_moved = None;
    for _ in 0..MAX_ITERATIONS {
        if high - low < INTERVAL_TOLERANCE || at_high == at_low {
            break;
        }
        let trial = low - at_low * (high - low) / (at_high - at_low);
        let at_trial = evaluate(trial)? - factor;
        if at_trial.abs() < FACTOR_TOLERANCE {
            return Ok(trial);
        }
        let moves_low = at_trial < 0.0;
        let weight = if low_moved == Some(moves_low) {
            0.5
        } else {
            1.0
        };
        if moves_low {
            (low, at_low, at_high) = (trial, at_trial, weight * at_high);
        } else {
            (high, at_high, at_low) = (trial, at_trial, weight * at_low);
        }
        low_moved = Some(moves_low);
    }
    Ok(0.5 * (low + high))
}
