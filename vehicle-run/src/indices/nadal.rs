//! Nadal's limit for a case.

use std::sync::OnceLock;

use dashpot_rail::contact::{Installation, Pair, PairError};
use dashpot_rail::indices::nadal_limit;
use serde::Serialize;

/// Nadal's limit of `Y/Q`, with the values from which it is computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Nadal {
    /// Flange angle of the wheel profile, rad.
    pub flange_angle_rad: f64,
    /// Friction coefficient of wheel and rail.
    pub friction: f64,
    /// The limit, dimensionless.
    pub limit: f64,
}

impl Nadal {
    /// Computes the limit for a friction coefficient and the wheel profile S1002, which all vehicles have.
    pub(super) fn new(friction: f64) -> Self {
        let flange_angle_rad = flange_angle_rad();
        Self {
            flange_angle_rad,
            friction,
            limit: nadal_limit(flange_angle_rad, friction),
        }
    }
}

/// Flange angle of the S1002 profile, rad. The angle does not depend on the wheel radius. It is computed once, because
/// building the profile pair takes longer than simulating one second.
fn flange_angle_rad() -> f64 {
    static ANGLE: OnceLock<Result<f64, PairError>> = OnceLock::new();
    let angle = ANGLE.get_or_init(|| {
        let pair = Pair::standard(Installation::default())?;
        Ok(pair.flange_angle_rad())
    });
    // The standard profiles always form a pair.
    *angle.as_ref().unwrap_or(&f64::NAN)
}
