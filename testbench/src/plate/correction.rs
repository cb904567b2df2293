//! Geometries that have a given correction factor Ce.

use super::{PlateError, PressureArea, Profile, Resolution, RoundBosses, Stack};

/// Most trials; ten do.
const TRIALS: u32 = 60;
/// Interval that is narrow enough (1).
const WIDTH: f64 = 1e-13;
/// Rounding of a factor: no trial comes nearer to one.
const ROUNDING: f64 = 1e-9;

/// Where a pressure that is full from the clamp on begins its decay, `((r_w - r)/(r_w - r_f))^n`, so that the correction
/// factor is `factor`: the radius r_f (m).
///
/// # Errors
/// No radius has the factor.
pub fn fitted_full_radius_m(
    stack: &Stack,
    exponent: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let width = free - clamp;
    fitted("radius of full pressure", factor, [1e-3, 1.0], |part| {
        let full = clamp + part * width;
        let area = PressureArea::Ring(Profile {
            full_m: [clamp, full],
            ends_m: [clamp, free],
            exponent,
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|part| clamp + part * width)
}

/// Width (m) over which a pressure that is full in the middle decays to nothing at clamp and edge, so that the correction factor
/// is `factor`.
///
/// # Errors
/// No width has the factor.
pub fn fitted_decay_width_m(
    stack: &Stack,
    exponent: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let widest = 0.5 * (free - clamp);
    fitted("width of decay", factor, [1e-3, 1.0], |part| {
        let width = (1.0 - part) * widest;
        let area = PressureArea::Ring(Profile {
            full_m: [clamp + width, free - width],
            ends_m: [clamp, free],
            exponent,
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|part| (1.0 - part) * widest)
}

/// Share of the circumference that sectors of a profile take, so that the correction factor is `factor`. The factor is
/// the share times that of the ring: only the harmonic of order zero has a mean.
///
/// # Errors
/// The whole ring has less than the factor.
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
            least: 0.0,
            greatest: ring,
        });
    }
    Ok(factor / ring)
}

/// Radius (m) of round bosses whose holes have `hole_share` of it, so that the correction factor is `factor`.
///
/// # Errors
/// Bosses from almost none to where they meet the clamp, the edge or each other do not have the factor.
pub fn fitted_boss_radius_m(
    stack: &Stack,
    bosses: RoundBosses,
    hole_share: f64,
    factor: f64,
    resolution: Resolution,
) -> Result<f64, PlateError> {
    let greatest = bosses.greatest_radius_m(stack.clamp_radius_m(), stack.free_radius_m());
    fitted("boss radius", factor, [1e-3, 1.0], |part| {
        let boss_radius_m = part * greatest;
        let area = PressureArea::Round(RoundBosses {
            boss_radius_m,
            hole_radius_m: hole_share * boss_radius_m,
            ..bosses
        });
        stack.correction_factor(&area, resolution)
    })
    .map(|part| part * greatest)
}

/// Where in an interval `of`, which rises, is `factor`.
fn fitted(
    geometry: &'static str,
    factor: f64,
    [mut low, mut high]: [f64; 2],
    of: impl Fn(f64) -> Result<f64, PlateError>,
) -> Result<f64, PlateError> {
    let (least, greatest) = (of(low)?, of(high)?);
    if !(least..=greatest).contains(&factor) {
        return Err(PlateError::OutOfReach {
            geometry,
            factor,
            least,
            greatest,
        });
    }
    // Regula falsi, Illinois variant: an end that is kept again counts half.
    let (mut at_low, mut at_high) = (least - factor, greatest - factor);
    let mut rose = None;
    for _ in 0..TRIALS {
        if high - low < WIDTH || at_high == at_low {
            break;
        }
        let trial = low - at_low * (high - low) / (at_high - at_low);
        let at_trial = of(trial)? - factor;
        if at_trial.abs() < ROUNDING {
            return Ok(trial);
        }
        let rises = at_trial < 0.0;
        let again = if rose == Some(rises) { 0.5 } else { 1.0 };
        if rises {
            (low, at_low, at_high) = (trial, at_trial, again * at_high);
        } else {
            (high, at_high, at_low) = (trial, at_trial, again * at_low);
        }
        rose = Some(rises);
    }
    Ok(0.5 * (low + high))
}
