//! The contact of a vehicle's wheels: standard profiles under its mean wheel load.

use std::path::PathBuf;
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Standstill, VehicleError, VehicleParameters};

use super::VehicleStudyError;

/// S1002 wheels of the first wheelset's radius on UIC 60 rails at 1:40, their softness that of the vehicle's mean wheel load.
///
/// # Errors
/// A vehicle that is refused or has no wheelset; a load that wheel and rail do not carry.
pub fn geometry(vehicle: &VehicleParameters) -> Result<ContactGeometry, VehicleStudyError> {
    let standstill = Standstill::new(vehicle)?;
    let loads = standstill.axle_loads_n();
    let Some(wheelset) = vehicle.wheelsets.first() else {
        return Err(VehicleError::NoWheelset.into());
    };
    let installation = Installation {
        wheel_radius_m: wheelset.radius_m,
        ..Installation::default()
    };
    let mean_n = loads.iter().sum::<f64>() / (2 * loads.len()) as f64;
    let pair = Pair::standard(installation)?;
    Ok(ContactGeometry::new(pair, Steel::default(), mean_n)?)
}

/// Constant friction with a coefficient.
pub fn friction(coefficient: f64) -> Friction {
    Friction {
        static_coefficient: coefficient,
        ..Friction::default()
    }
}

/// Tabulated contact with the book of creep forces. The tables are kept in the user's cache folder, so that they are computed once.
///
/// # Errors
/// As [`geometry`]; a friction or damping out of bounds; a cache folder that cannot be used.
pub fn tabulated(
    vehicle: &VehicleParameters,
    friction_coefficient: f64,
    normal_damping_s_per_m: f64,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleStudyError> {
    let geometry = geometry(vehicle)?;
    let tables = Tables::cached(&cache_folder(), geometry, Grid::default())?;
    let friction = friction(friction_coefficient);
    let contact = WheelsetContact::new(Arc::new(tables), KalkerBook::new(), friction)?;
    Ok(Arc::new(
        contact.with_normal_damping(normal_damping_s_per_m)?,
    ))
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
