//! Wheel-rail contact of a vehicle: standard profiles under its mean wheel load.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Standstill, VehicleError, VehicleParameters};

use super::VehicleRunError;

/// Inputs that determine the contact tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TablesKey {
    /// Wheel radius of the first wheelset, m.
    pub wheel_radius_m: f64,
    /// Mean wheel load of the vehicle at standstill, N.
    pub mean_wheel_load_n: f64,
}

/// Inputs that determine the contact of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSetup {
    tables: TablesKey,
    friction: f64,
    normal_damping_s_per_m: f64,
}

impl ContactSetup {
    /// Derives the setup from a vehicle, a friction coefficient and the normal damping (s/m).
    ///
    /// # Errors
    /// Invalid vehicle, or one without wheelsets.
    pub fn new(
        vehicle: &VehicleParameters,
        friction: f64,
        normal_damping_s_per_m: f64,
    ) -> Result<Self, VehicleError> {
        let standstill = Standstill::new(vehicle)?;
        let loads = standstill.axle_loads_n();
        let first = vehicle.wheelsets.first();
        Ok(Self {
            tables: TablesKey {
                wheel_radius_m: first.ok_or(VehicleError::NoWheelset)?.radius_m,
                mean_wheel_load_n: loads.iter().sum::<f64>() / (2 * loads.len()) as f64,
            },
            friction,
            normal_damping_s_per_m,
        })
    }

    /// Inputs of the contact tables. Setups that differ only in friction or damping share their tables.
    pub fn tables_key(&self) -> TablesKey {
        self.tables
    }

    /// Returns the contact tables, about 43 MB. They are computed once and kept in the user's cache folder.
    ///
    /// # Errors
    /// No contact geometry exists for the wheel load, or the cache folder cannot be used.
    pub fn tables(&self) -> Result<Arc<Tables>, VehicleRunError> {
        let tables = Tables::cached(&cache_folder(), self.geometry()?, Grid::default())?;
        Ok(Arc::new(tables))
    }

    /// Loads the contact tables from another folder, under the file name of [`Self::tables_file`]; computes and writes
    /// nothing.
    ///
    /// # Errors
    /// The file is missing or contains other tables.
    pub fn tables_in(&self, folder: &Path) -> Result<Arc<Tables>, VehicleRunError> {
        let tables = Tables::kept(folder, self.geometry()?, Grid::default())?;
        Ok(Arc::new(tables))
    }

    /// File in which [`Self::tables`] keeps the contact tables.
    ///
    /// # Errors
    /// See [`Self::geometry`].
    pub fn tables_file(&self) -> Result<PathBuf, VehicleRunError> {
        let name = Tables::file_name(&self.geometry()?, &Grid::default());
        Ok(cache_folder().join(name))
    }

    /// Builds the contact geometry: S1002 wheels with the first wheelset's radius on UIC 60 rails at 1:40, with the
    /// elastic deformation at the mean wheel load.
    ///
    /// # Errors
    /// No contact geometry exists for the wheel load.
    pub fn geometry(&self) -> Result<ContactGeometry, VehicleRunError> {
        let installation = Installation::default().with_wheel_radius_m(self.tables.wheel_radius_m);
        let pair = Pair::standard(installation)?;
        let load_n = self.tables.mean_wheel_load_n;
        Ok(ContactGeometry::new(pair, Steel::default(), load_n)?)
    }
}

/// Friction with a constant coefficient.
pub fn friction(coefficient: f64) -> Friction {
    Friction::constant(coefficient)
}

/// Builds the tabulated contact of a vehicle; computes and caches its tables if necessary.
///
/// # Errors
/// See [`ContactSetup::new`], [`ContactSetup::tables`] and [`from_tables`].
pub fn tabulated(
    vehicle: &VehicleParameters,
    friction_coefficient: f64,
    normal_damping_s_per_m: f64,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleRunError> {
    let setup = ContactSetup::new(vehicle, friction_coefficient, normal_damping_s_per_m)?;
    from_tables(setup.tables()?, &setup)
}

/// Builds the tabulated contact from existing tables, with creep forces from Kalker's book.
///
/// # Errors
/// Friction or damping is out of bounds.
pub fn from_tables(
    tables: Arc<Tables>,
    setup: &ContactSetup,
) -> Result<Arc<WheelsetContact<KalkerBook>>, VehicleRunError> {
    let friction = friction(setup.friction);
    let contact = WheelsetContact::new(tables, KalkerBook::new(), friction)?;
    let damping = setup.normal_damping_s_per_m;
    Ok(Arc::new(contact.with_normal_damping(damping)?))
}

/// Folder `dashpot` in the user's cache folder, or in the folder for temporary files if there is no home folder.
fn cache_folder() -> PathBuf {
    let configured = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let configured = configured.filter(|folder| folder.is_absolute());
    let home = || Some(std::env::home_dir()?.join(".cache"));
    configured
        .or_else(home)
        .unwrap_or_else(std::env::temp_dir)
        .join("dashpot")
}
