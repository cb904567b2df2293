//! Pressure areas for the valves of the source paper. The paper gives the kind of each area but no dimensions, so some
//! are assumed and the remaining one is fitted to the valve's correction factor Ce.
//!
//! Foot valve (Fig. 3 of the paper): a ring of full pressure that decays to zero. Piston valves (Fig. 2): six bosses,
//! each with full pressure over a circle that decays to zero around it.

use dashpot_core::characteristic::ShimPackValve;
use serde::Serialize;

use super::{
    PlateError, PressureArea, Profile, Resolution, RoundBosses, Stack, fitted_boss_radius_m,
    fitted_decay_width_m, fitted_full_radius_m, fitted_share,
};

/// Number of bosses of a 6/6-hole piston.
const BOSSES: u32 = 6;
/// Assumed radius of a hole, divided by the radius of its boss.
const HOLE_SHARE: f64 = 0.75;
/// Assumed exponent of a decay.
const QUADRATIC: f64 = 2.0;

/// Widths of the fitted sectors, as shares of the free width.
pub const WIDTHS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// A geometry with the correction factor Ce of a valve.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Fit {
    /// Full pressure from the clamp to a radius, decaying to zero at the edge.
    Decay {
        /// Exponent of the decay (1).
        exponent: f64,
        /// Fitted outer radius of the area under full pressure (m).
        full_radius_m: f64,
    },
    /// Full pressure in the middle, decaying to zero at clamp and edge over the same width.
    DecayOnBothSides {
        /// Exponent of the decay (1).
        exponent: f64,
        /// Fitted width of the decay (m).
        width_m: f64,
    },
    /// Sectors; their number does not matter.
    Sectors {
        /// Inner and outer radius of the area under full pressure (m).
        full_m: [f64; 2],
        /// Fitted share of the circumference (1).
        share: f64,
    },
    /// Six round bosses.
    RoundBosses {
        /// Radius of the pitch circle (m).
        pitch_radius_m: f64,
        /// Radius of a hole, divided by the radius of its boss (1).
        hole_share: f64,
        /// Fitted radius of a boss (m).
        boss_radius_m: f64,
    },
}

/// Returns the area assumed for a valve with correction factor `factor`; a factor of 1 means the whole disc.
///
/// # Errors
/// Returns an error if no area of this kind has this correction factor.
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

/// True if the pressure on a valve is axisymmetric, as on the foot valve.
pub fn is_ring(valve: ShimPackValve) -> bool {
    matches!(valve, ShimPackValve::FootCompression)
}

/// Returns geometries, all of the kind of area that the valve has, whose correction factor is `factor`; empty if there
/// are none.
///
/// # Errors
/// Returns an error if the plate has no solution.
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
            fits.extend(if_reachable(fit)?.map(|full_radius_m| Fit::Decay {
                exponent,
                full_radius_m,
            }));
            let fit = fitted_decay_width_m(stack, exponent, factor, resolution);
            fits.extend(
                if_reachable(fit)?.map(|width_m| Fit::DecayOnBothSides { exponent, width_m }),
            );
        }
        return Ok(fits);
    }
    for share in WIDTHS {
        let profile = middle_ring(stack, share);
        let fit = fitted_share(stack, profile, factor, resolution);
        fits.extend(if_reachable(fit)?.map(|share| Fit::Sectors {
            full_m: profile.full_m,
            share,
        }));
    }
    for hole_share in [1.0, 0.9, HOLE_SHARE, 0.65] {
        for i in 1..40 {
            let pitch_radius_m = clamp + (free - clamp) * f64::from(i) / 40.0;
            let bosses = bosses(pitch_radius_m);
            let fit = fitted_boss_radius_m(stack, bosses, hole_share, factor, resolution);
            fits.extend(if_reachable(fit)?.map(|boss_radius_m| Fit::RoundBosses {
                pitch_radius_m,
                hole_share,
                boss_radius_m,
            }));
        }
    }
    Ok(fits)
}

/// Returns a profile with full pressure on a ring in the middle of the free width; the ring covers `share` of that
/// width.
pub fn middle_ring(stack: &Stack, share: f64) -> Profile {
    let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
    let (middle, half) = (0.5 * (clamp + free), 0.5 * share * (free - clamp));
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

/// Returns the fitted value; `None` if no geometry has the requested correction factor.
fn if_reachable(fit: Result<f64, PlateError>) -> Result<Option<f64>, PlateError> {
    match fit {
        Ok(fitted) => Ok(Some(fitted)),
        Err(PlateError::OutOfReach { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
