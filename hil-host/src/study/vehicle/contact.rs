//! The contact of a vehicle's wheels: standard profiles under its mean wheel load.

use std::path::PathBuf;
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Standstill, VehicleError, VehicleParameters};

use super::VehicleStudyError;

/// What the contact of a vehicle follows from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactOf {
    wheel_radius_m: f64,
    mean_wheel_load_n: f64,
    friction: f64,
    normal_damping_s_per_m: f64,
}

impl ContactOf {
    /// Of a vehicle with friction and normal damping.
    ///
    /// # Errors
    /// A vehicle that is refused or has no wheelset.
    pub fn new(
        vehicle: &VehicleParameters,
        friction: f64,
        normal_damping_s_per_m: f64,
    ) -> Result<Self, VehicleError> {
        let standstill = Standstill::new(vehicle)?;
        let loads = standstill.axle_loads_n();
        let first = vehicle.wheelsets.first();
        Ok(Self {
            wheel_radius_m: first.ok_or(VehicleError::NoWheelset)?.radius_m,
            mean_wheel_load_n: loads.iter().sum::<f64>() / (2 * loads.len()) as f64,
            friction,
            normal_damping_s_per_m,
        })
    }

    /// S1002 wheels of the first wheelset's radius on UIC 60 rails at 1:40, their softness that of the vehicle's mean wheel load.
    ///
    /// # Errors
    /// A load that wheel and rail do not carry.
    pub fn geometry(&self) -> Result<ContactGeometry, VehicleStudyError> {
        let installation = Installation {
            wheel_radius_m: self.wheel_radius_m,
            ..Installation::default()
        };
        let pair = Pair::standard(installation)?;
        let load_n = self.mean_wheel_load_n;
        Ok(ContactGeometry::new(pair, Steel::default(), load_n)?)
    }
}

/// Constant friction with a coefficient.
pub fn friction(coefficient: f64) -> Friction {
    Friction {
        static_coefficient: coefficient,
        ..Friction::default()
    }
}

/// Tabulated contact of a vehicle, see [`of`].
///
/// # Errors
/// As [`ContactOf::new`] and [`of`].
pub fn tabulated(
    vehicle: &VehicleParameters,
    friction_coefficient: f64,
    normal_damping_s_per_m: f64,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleStudyError> {
    of(&ContactOf::new(
        vehicle,
        friction_coefficient,
        normal_damping_s_per_m,
    )?)
}

/// Tabulated contact with the book of creep forces. The tables are kept in the user's cache folder, so that they are computed once.
///
/// # Errors
/// A load that wheel and rail do not carry; a friction or damping out of bounds; a cache folder that cannot be used.
pub fn of(contact: &ContactOf) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleStudyError> {
    let tables = Tables::cached(&cache_folder(), contact.geometry()?, Grid::default())?;
    let friction = friction(contact.friction);
    let made = WheelsetContact::new(Arc::new(tables), KalkerBook::new(), friction)?;
    let damping = contact.normal_damping_s_per_m;
    Ok(Arc::new(made.with_normal_damping(damping)?))
}

/// `dashpot` in the folder of the user's caches; beside temporary files where there is none.
fn cache_folder() -> PathBuf {
    let given = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let given = given.filter(|folder| folder.is_absolute());
    let home = || Some(std::env::home_dir()?.join(".cache"));
    given
        .or_else(home)
        .unwrap_or_else(std::env::temp_dir)
        .join("dashpot")
}
