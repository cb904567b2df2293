//! Load that a friction element follows, and checks of friction elements.

use nalgebra::Vector3;

use super::element::{Element, Law};
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

/// Minimum load of a spring at standstill that friction can follow, N.
const MIN_LOAD_N: f64 = 1.0;

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
        VehicleError::check(
            owner,
            "friction_coefficient",
            load.coefficient,
            COEFFICIENT,
        )
    })
}

/// Vertical stiffness of an element whose load friction can follow, N/m.
pub(super) fn vertical_stiffness(law: &Law) -> Option<f64> {
    match law {
        Law::SpringDamper {
            stiffness_n_per_m, ..
        }
        | Law::Bush {
            stiffness_n_per_m, ..
        } => Some(stiffness_n_per_m[2]).filter(|stiffness| *stiffness > 0.0),
        _ => None,
    }
}

/// Checks that the friction of an element follows a spring that carries a load at standstill. `forces` are those of all
/// elements on their second ends, N.
pub(super) fn check_load(
    element: &Element,
    elements: &[Element],
    forces: &[Vector3<f64>],
) -> Result<(), VehicleError> {
    let Law::Friction {
        load: Some(load), ..
    } = &element.law
    else {
        return Ok(());
    };
    let refused = |reason: String| VehicleError::FrictionSpring {
        element: element.name.clone(),
        spring: load.spring.clone(),
        reason,
    };
    let springs = || {
        let springs = elements
            .iter()
            .zip(forces)
            .filter(|(element, _)| vertical_stiffness(&element.law).is_some());
        springs.map(|(element, force)| (element.name.as_str(), force.z))
    };
    match springs().find(|(name, _)| *name == load.spring) {
        Some((_, force)) if force.abs() >= MIN_LOAD_N => Ok(()),
        Some(_) => Err(refused(
            "which carries no load at standstill, allowed: a spring that carries weight".to_owned(),
        )),
        None => {
            let names: Vec<&str> = springs().map(|(name, _)| name).collect();
            Err(refused(format!(
                "which is not a spring with vertical stiffness; allowed: {}",
                names.join(", ")
            )))
        }
    }
}
