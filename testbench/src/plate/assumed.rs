//! Pressure areas for the valves of the source paper, which tells their kind and no dimension: one is assumed, and what it
//! leaves open is fitted to the valve's correction factor Ce.
//!
//! Foot (the paper's Fig. 3): a ring under full pressure with decays to nothing. Piston (its Fig. 2): six bosses, each full over
//! a circle and decaying to nothing around it.

use dashpot_core::characteristic::ShimPackValve;
use serde::Serialize;

use super::{
    PlateError, PressureArea, Profile, Resolution, RoundBosses, Stack, fitted_boss_radius_m,
    fitted_decay_width_m, fitted_full_radius_m, fitted_share,
};

/// Bosses of a 6/6-hole piston.
const BOSSES: u32 = 6;
/// Assumed radius of a hole over that of its boss.
const HOLE_SHARE: f64 = 0.75;
/// Assumed exponent of a decay.
const QUADRATIC: f64 = 2.0;

/// Parts of the width that sectors of the fits take.
pub const WIDTHS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// A geometry that has a valve's Ce.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Fit {
    /// Full from the clamp to a radius, decaying to nothing at the edge.
    Decay {
        /// Exponent of the decay (1).
        exponent: f64,
        /// The radius fitted (m).
        full_radius_m: f64,
    },
    /// Full in the middle, decaying to nothing at clamp and edge over the same width.
    DecayOnBothSides {
        /// Exponent of the decay (1).
        exponent: f64,
        /// The width fitted (m).
        width_m: f64,
    },
    /// Sectors, however many.
    Sectors {
        /// Radii between which the pressure is full (m).
        full_m: [f64; 2],
        /// The share of the circumference fitted (1).
        share: f64,
    },
    /// Six round bosses.
    RoundBosses {
        /// Radius of the circle of their middles (m).
        pitch_radius_m: f64,
        /// Radius of a hole over that of its boss (1).
        hole_share: f64,
        /// The radius of a boss fitted (m).
        boss_radius_m: f64,
    },
}

/// The area assumed at a valve whose correction factor is `factor`; that of 1 is the whole disc.
///
/// # Errors
/// The kind of area does not reach the factor.
pub fn assumed_area(
    valve: ShimPackValve,
    stack: &Stack,
    factor: f64,
    resolution: Resolution,
) -> Result<PressureArea, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    if factor == 1.0 {
        return Ok(PressureArea::whole(clamp, free));
    }
    if is_ring(valve) {
        let full = fitted_full_radius_m(stack, QUADRATIC, factor, resolution)?;
        return Ok(PressureArea::Ring(Profile {
            full_m: [clamp, full],
            ends_m: [clamp, free],
            exponent: QUADRATIC,
        }));
    }
    let bosses = bosses(0.5 * (clamp + free));
    let boss_radius_m = fitted_boss_radius_m(stack, bosses, HOLE_SHARE, factor, resolution)?;
    Ok(PressureArea::Round(RoundBosses {
        hole_radius_m: HOLE_SHARE * boss_radius_m,
        boss_radius_m,
        ..bosses
    }))
}

/// Whether a valve's pressure is the same all round, as at the foot.
pub fn is_ring(valve: ShimPackValve) -> bool {
    matches!(valve, ShimPackValve::FootCompression)
}

/// Geometries of the valve's kind of area that have the correction factor `factor`: none where none reaches it.
///
/// # Errors
/// The plate has no solution.
pub fn fits(
    valve: ShimPackValve,
    stack: &Stack,
    factor: f64,
    resolution: Resolution,
) -> Result<Vec<Fit>, PlateError> {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let mut fits = Vec::new();
    if is_ring(valve) {
        for exponent in [1.0, 2.0, 3.0] {
            let fit = fitted_full_radius_m(stack, exponent, factor, resolution);
            fits.extend(reached(fit)?.map(|full_radius_m| Fit::Decay {
                exponent,
                full_radius_m,
            }));
            let fit = fitted_decay_width_m(stack, exponent, factor, resolution);
            fits.extend(reached(fit)?.map(|width_m| Fit::DecayOnBothSides { exponent, width_m }));
        }
        return Ok(fits);
    }
    for part in WIDTHS {
        let profile = middle_ring(stack, part);
        let fit = fitted_share(stack, profile, factor, resolution);
        fits.extend(reached(fit)?.map(|share| Fit::Sectors {
            full_m: profile.full_m,
            share,
        }));
    }
    for hole_share in [1.0, 0.9, HOLE_SHARE, 0.65] {
        for i in 1..40 {
            let pitch_radius_m = clamp + (free - clamp) * f64::from(i) / 40.0;
            let bosses = bosses(pitch_radius_m);
            let fit = fitted_boss_radius_m(stack, bosses, hole_share, factor, resolution);
            fits.extend(reached(fit)?.map(|boss_radius_m| Fit::RoundBosses {
                pitch_radius_m,
                hole_share,
                boss_radius_m,
            }));
        }
    }
    Ok(fits)
}

/// Full pressure in the middle of a stack, on a part of its width.
pub fn middle_ring(stack: &Stack, part: f64) -> Profile {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let (middle, half) = (0.5 * (clamp + free), 0.5 * part * (free - clamp));
    Profile::full((middle - half).max(clamp), (middle + half).min(free))
}

fn bosses(pitch_radius_m: f64) -> RoundBosses {
    RoundBosses {
        count: BOSSES,
        pitch_radius_m,
        hole_radius_m: 0.0,
        boss_radius_m: 0.0,
        exponent: QUADRATIC,
    }
}

/// What was fitted, none where no geometry reaches the factor.
fn reached(fit: Result<f64, PlateError>) -> Result<Option<f64>, PlateError> {
    match fit {
        Ok(fitted) => Ok(Some(fitted)),
        Err(PlateError::OutOfReach { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
