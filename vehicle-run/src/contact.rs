//! Wheel-rail contact of a vehicle: its distinct pairs of profiles, their tables, and the contact of each wheelset.

use std::path::PathBuf;
use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_files::contact::{ContactParameters, SharedProfile};
use dashpot_rail::contact::{
    ContactGeometry, Installation, Pair, PatchSource, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Standstill, VehicleError, VehicleParameters};

use super::VehicleRunError;

/// Contact of a wheelset.
pub type Contact<S = Tables> = Arc<WheelsetContact<KalkerBook, S>>;

/// A wheel on its rail: the inputs that determine contact tables.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelOnRail {
    wheel: SharedProfile,
    rail: SharedProfile,
    installation: Installation,
}

impl WheelOnRail {
    /// Builds the contact geometry, without tables.
    ///
    /// # Errors
    /// A dimension is out of bounds, or the profiles do not fit each other.
    pub fn geometry(&self) -> Result<ContactGeometry, VehicleRunError> {
        let pair = Pair::new((*self.wheel).clone(), &self.rail, self.installation)?;
        Ok(ContactGeometry::new(pair, Steel::default())?)
    }

    /// Returns the contact tables, 4 to 5 MB. They are computed once and kept in the user's cache folder; where it
    /// cannot be written, they are computed each time, in two seconds of processor time.
    ///
    /// # Errors
    /// See [`Self::geometry`].
    pub fn tables(&self) -> Result<Arc<Tables>, VehicleRunError> {
        // A browser has no folder.
        if cfg!(target_family = "wasm") {
            return self.computed();
        }
        let cached = Tables::cached(&cache_folder(), self.geometry()?);
        Ok(Arc::new(cached.tables))
    }

    /// Computes the contact tables, without reading or writing a file.
    ///
    /// # Errors
    /// See [`Self::geometry`].
    pub fn computed(&self) -> Result<Arc<Tables>, VehicleRunError> {
        Ok(Arc::new(Tables::new(self.geometry()?)))
    }

    /// Reads the contact tables from the bytes of a file.
    ///
    /// # Errors
    /// The bytes are not these tables.
    pub fn tables_from(&self, bytes: &[u8]) -> Result<Arc<Tables>, VehicleRunError> {
        let tables = Tables::from_bytes(self.geometry()?, bytes);
        Ok(Arc::new(tables.map_err(VehicleRunError::Tables)?))
    }

    /// Name of the file of the contact tables.
    ///
    /// # Errors
    /// See [`Self::geometry`].
    pub fn tables_file_name(&self) -> Result<String, VehicleRunError> {
        Ok(Tables::file_name(&self.geometry()?))
    }
}

/// Inputs that determine the contact of each wheelset of a vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSetup {
    /// Distinct pairs of wheel and rail.
    pairs: Vec<WheelOnRail>,
    /// Pairs of the left and the right side of each wheelset.
    wheelsets: Vec<[usize; 2]>,
    friction: Friction,
    normal_damping_s_per_m: f64,
}

impl ContactSetup {
    /// Derives the setup from a vehicle, its contact, the static friction coefficient and the normal damping (s/m).
    ///
    /// # Errors
    /// Invalid vehicle, or one without wheelsets.
    pub fn new(
        vehicle: &VehicleParameters,
        contact: &ContactParameters,
        friction: f64,
        normal_damping_s_per_m: f64,
    ) -> Result<Self, VehicleError> {
        Standstill::new(vehicle)?;
        if vehicle.wheelsets.is_empty() {
            return Err(VehicleError::NoWheelset);
        }
        let mut pairs: Vec<WheelOnRail> = Vec::new();
        let mut wheelsets = Vec::with_capacity(vehicle.wheelsets.len());
        for (number, wheelset) in vehicle.wheelsets.iter().enumerate() {
            wheelsets.push([0, 1].map(|side| {
                let pair = WheelOnRail {
                    wheel: contact.wheel(number, side).clone(),
                    rail: contact.rail(side).clone(),
                    installation: contact.installation(wheelset.radius_m),
                };
                let known = pairs.iter().position(|known| *known == pair);
                known.unwrap_or_else(|| {
                    pairs.push(pair);
                    pairs.len() - 1
                })
            }));
        }
        Ok(Self {
            pairs,
            wheelsets,
            friction: contact.friction(friction),
            normal_damping_s_per_m,
        })
    }

    /// Derives the setup of a case.
    ///
    /// # Errors
    /// Same errors as [`Self::new`].
    pub fn of_case(case: &Case) -> Result<Self, VehicleError> {
        let damping_s_per_m = case.normal_damping_s_per_m;
        Self::new(&case.vehicle, &case.contact, case.friction, damping_s_per_m)
    }

    /// Distinct pairs of wheel and rail, whose tables [`Self::contacts`] needs. Setups that differ only in friction or
    /// damping have equal pairs.
    pub fn pairs(&self) -> &[WheelOnRail] {
        &self.pairs
    }

    /// Returns the contact of each wheelset with creep forces from Kalker's book. `sources` are the tables or
    /// geometries of [`Self::pairs`]. Equal wheelsets share a contact.
    ///
    /// # Errors
    /// Friction or damping is out of bounds, or the number of sources differs from that of the pairs.
    pub fn contacts<S: PatchSource>(
        &self,
        sources: &[Arc<S>],
    ) -> Result<Vec<Contact<S>>, VehicleRunError> {
        if sources.len() != self.pairs.len() {
            return Err(VehicleRunError::Sources {
                sources: sources.len(),
                pairs: self.pairs.len(),
            });
        }
        let mut built: Vec<([usize; 2], Contact<S>)> = Vec::new();
        for sides in &self.wheelsets {
            if built.iter().any(|(known, _)| known == sides) {
                continue;
            }
            let of_sides = sides.map(|pair| Arc::clone(&sources[pair]));
            let contact = WheelsetContact::with_sides(of_sides, KalkerBook::new(), self.friction)?;
            let contact = contact.with_normal_damping(self.normal_damping_s_per_m)?;
            built.push((*sides, Arc::new(contact)));
        }
        let of_sides = |sides: &[usize; 2]| {
            let found = built.iter().find(|(known, _)| known == sides);
            found.map(|(_, contact)| Arc::clone(contact))
        };
        Ok(self.wheelsets.iter().filter_map(of_sides).collect())
    }

    /// Returns the tables of each pair; computes and caches them if necessary.
    ///
    /// # Errors
    /// See [`WheelOnRail::tables`].
    pub fn tables(&self) -> Result<Vec<Arc<Tables>>, VehicleRunError> {
        self.pairs.iter().map(WheelOnRail::tables).collect()
    }

    /// Returns the contact of each wheelset with the [`tables`](Self::tables) of its pairs.
    ///
    /// # Errors
    /// See [`Self::tables`] and [`Self::contacts`].
    pub fn tabulated(&self) -> Result<Vec<Contact>, VehicleRunError> {
        self.contacts(&self.tables()?)
    }

    /// Returns the contact of each wheelset without tables, for a few evaluations.
    ///
    /// # Errors
    /// See [`WheelOnRail::geometry`] and [`Self::contacts`].
    pub fn exact(&self) -> Result<Vec<Contact<ContactGeometry>>, VehicleRunError> {
        let geometries = self.pairs.iter().map(|pair| pair.geometry().map(Arc::new));
        let geometries: Result<Vec<_>, _> = geometries.collect();
        self.contacts(&geometries?)
    }
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
