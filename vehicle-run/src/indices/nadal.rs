//! Nadal's limit of a case.

use std::sync::OnceLock;

use dashpot_rail::contact::{Installation, Pair, PairError};
use dashpot_rail::indices::nadal_limit;
use serde::Serialize;

/// Nadal's limit of `Y/Q` and what it is of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Nadal {
    /// Flange angle of the wheels' profile, rad.
    pub flange_angle_rad: f64,
    /// Friction of wheel and rail.
    pub friction: f64,
    /// The limit, dimensionless.
    pub limit: f64,
}

impl Nadal {
    /// Of the profile that all vehicles have, S1002, and a friction.
    pub(super) fn new(friction: f64) -> Self {
        let flange_angle_rad = flange_angle_rad();
        Self {
            flange_angle_rad,
            friction,
            limit: nadal_limit(flange_angle_rad, friction),
        }
    }
}

/// Does not depend on the wheels' radius; found once, as a pair takes longer than a second of a run.
fn flange_angle_rad() -> f64 {
    static ANGLE: OnceLock<Result<f64, PairError>> = OnceLock::new();
    let angle = ANGLE.get_or_init(|| {
        let pair = Pair::standard(Installation::default())?;
        Ok(pair.flange_angle_rad())
    });
    // The standard profiles make a pair.
    *angle.as_ref().unwrap_or(&f64::NAN)
}
