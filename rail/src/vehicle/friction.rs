//! Load that a friction element follows, and bounds of its values.

use super::error::VehicleError;

/// Friction that follows the load of a spring.
///
/// The load is the vertical force of the spring's stiffness, positive in the direction in which it carries weight at
/// standstill, and zero in the other direction. The dashpot of the spring does not count.
///
/// ```
/// use dashpot_rail::vehicle::FrictionLoad;
/// let load = FrictionLoad::new(0.1, "front spring 1");
/// assert_eq!(load.coefficient, 0.1);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct FrictionLoad {
    /// Limit of the friction force, divided by the load.
    pub coefficient: f64,
    /// Name of the spring: a spring-damper or a bush.
    pub spring: String,
}

impl FrictionLoad {
    /// Returns friction of `coefficient` times the load of the element called `spring`.
    pub fn new(coefficient: f64, spring: impl Into<String>) -> Self {
        Self {
            coefficient,
            spring: spring.into(),
        }
    }
}

const STIFFNESS: [f64; 2] = [1.0, 1e12];
const FRICTION_N: [f64; 2] = [0.0, 1e8];
const COEFFICIENT: [f64; 2] = [0.0, 10.0];

/// Checks the values of a friction element.
pub(super) fn check(
    owner: &str,
    stiffness_n_per_m: f64,
    friction_n: f64,
    load: Option<&FrictionLoad>,
) -> Result<(), VehicleError> {
    VehicleError::check(owner, "stiffness_n_per_m", stiffness_n_per_m, STIFFNESS)?;
    VehicleError::check(owner, "friction_n", friction_n, FRICTION_N)?;
    load.map_or(Ok(()), |load| {
        VehicleError::check(owner, "friction_coefficient", load.coefficient, COEFFICIENT)
    })
}
