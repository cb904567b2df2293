//! The contact of a vehicle's wheels: standard profiles under its mean wheel load.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Standstill, VehicleError, VehicleParameters};

use super::VehicleRunError;

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

    /// What the tables follow from: others may have another friction or damping.
    pub fn geometry_key(&self) -> [f64; 2] {
        [self.wheel_radius_m, self.mean_wheel_load_n]
    }

    /// The tables, some 43 MB. They are kept in the user's cache folder, so that they are computed once.
    ///
    /// # Errors
    /// A load that wheel and rail do not carry; a cache folder that cannot be used.
    pub fn tables(&self) -> Result<Arc<Tables>, VehicleRunError> {
        let tables = Tables::cached(&cache_folder(), self.geometry()?, Grid::default())?;
        Ok(Arc::new(tables))
    }

    /// Those in a file called as that of [`Self::tables`] is, in another folder; nothing is computed or written.
    ///
    /// # Errors
    /// A file that is not there or not these tables.
    pub fn tables_in(&self, folder: &Path) -> Result<Arc<Tables>, VehicleRunError> {
        let tables = Tables::kept(folder, self.geometry()?, Grid::default())?;
        Ok(Arc::new(tables))
    }

    /// The file in which [`Self::tables`] keeps them.
    ///
    /// # Errors
    /// As [`Self::geometry`].
    pub fn tables_file(&self) -> Result<PathBuf, VehicleRunError> {
        let name = Tables::file_name(&self.geometry()?, &Grid::default());
        Ok(cache_folder().join(name))
    }

    /// S1002 wheels of the first wheelset's radius on UIC 60 rails at 1:40, their softness that of the vehicle's mean wheel load.
    ///
    /// # Errors
    /// A load that wheel and rail do not carry.
    pub fn geometry(&self) -> Result<ContactGeometry, VehicleRunError> {
        let installation = Installation::default().with_wheel_radius_m(self.wheel_radius_m);
        let pair = Pair::standard(installation)?;
        let load_n = self.mean_wheel_load_n;
        Ok(ContactGeometry::new(pair, Steel::default(), load_n)?)
    }
}

/// Constant friction with a coefficient.
pub fn friction(coefficient: f64) -> Friction {
    Friction::constant(coefficient)
}

/// Tabulated contact of a vehicle.
///
/// # Errors
/// As [`ContactOf::new`], [`ContactOf::tables`] and [`with`].
pub fn tabulated(
    vehicle: &VehicleParameters,
    friction_coefficient: f64,
    normal_damping_s_per_m: f64,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleRunError> {
    let of = ContactOf::new(vehicle, friction_coefficient, normal_damping_s_per_m)?;
    with(of.tables()?, &of)
}

/// Tabulated contact with the book of creep forces.
///
/// # Errors
/// A friction or damping out of bounds.
pub fn with(
    tables: Arc<Tables>,
    contact: &ContactOf,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleRunError> {
    let friction = friction(contact.friction);
    let made = WheelsetContact::new(tables, KalkerBook::new(), friction)?;
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
