//! Elastic contact of a wheelset under load: patches, forces and creepages, and the elastic equivalent conicity.
//!
//! [`LoadedWheelset`] computes with [`ContactGeometry`], without tables: every shift is solved with fine strips.

mod equilibrium;
mod error;
mod patches;
mod pressed;
mod rolling_radius;
mod running;

use std::convert::Infallible;
use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Pair, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};

pub use error::LoadedWheelsetError;
pub use patches::{LoadedPatch, LoadedShift, LoadedWheel};
pub use running::{MAX_LATERAL_M, Running};

/// A wheelset whose wheels both carry the same vertical load.
///
/// ```
/// use std::sync::Arc;
/// use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
/// use dashpot_study::loaded_wheelset::{LoadedWheelset, Running};
/// let pair = Pair::standard(Installation::default())?;
/// let side = Arc::new(ContactGeometry::new(pair, Steel::default())?);
/// let wheelset = LoadedWheelset::new([Arc::clone(&side), side], Running::default().with_load_n(100e3))?;
/// let shift = &wheelset.at(&[3e-3])?[0];
/// let right = shift.right.as_ref().expect("an equilibrium");
/// assert!((right.vertical_force_n / 100e3 - 1.0).abs() < 1e-3);
/// // Exact theory has 1417 MPa for a wheel without roll.
/// assert!((right.patches[0].peak_pressure_pa / 1.417e9 - 1.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct LoadedWheelset {
    contact: WheelsetContact<KalkerBook, ContactGeometry>,
    running: Running,
}

impl LoadedWheelset {
    /// A wheelset with a left and a right side; the left one is given as its mirror image, as if it were on the right.
    ///
    /// # Errors
    /// A quantity of `running` is out of bounds.
    pub fn new(
        sides: [Arc<ContactGeometry>; 2],
        running: Running,
    ) -> Result<Self, LoadedWheelsetError> {
        running.check()?;
        let friction = Friction::constant(running.friction);
        Ok(Self {
            contact: WheelsetContact::with_sides(sides, KalkerBook::new(), friction)?,
            running,
        })
    }

    /// How the wheelset runs.
    pub fn running(&self) -> &Running {
        &self.running
    }

    /// The left and the right pair of profiles.
    fn pairs(&self) -> [&Pair; 2] {
        let [left, right] = self.contact.sources();
        [left.pair(), right.pair()]
    }

    /// True if both sides are the same object, so that a wheelset without yaw at opposite shifts is mirrored.
    pub fn is_symmetric(&self) -> bool {
        let [left, right] = self.contact.sources();
        Arc::ptr_eq(left, right)
    }

    /// Computes the wheelset at lateral shifts, m, at the height of the top of the rails, positive to the right.
    ///
    /// # Errors
    /// A shift is not within -[`MAX_LATERAL_M`] to [`MAX_LATERAL_M`].
    pub fn at(&self, lateral_m: &[f64]) -> Result<Vec<LoadedShift>, LoadedWheelsetError> {
        for shift_m in lateral_m {
            running::within("lateral_m", *shift_m, [-MAX_LATERAL_M, MAX_LATERAL_M])?;
        }
        let at = |shift_m: &f64| {
            self.equilibrium(*shift_m).map_or_else(
                || LoadedShift::without_equilibrium(*shift_m),
                |equilibrium| LoadedShift::new(*shift_m, &equilibrium, self.radius_m()),
            )
        };
        dashpot_workers::map(lateral_m, |shift_m| Ok(at(shift_m)))
    }

    /// The shifts at which a report shows the wheelset, m: every millimetre up to 8 mm, to both sides unless the left
    /// is the mirror image of the right.
    pub fn usual_shifts_m(&self) -> Vec<f64> {
        let first = if self.is_symmetric() && self.running.yaw_rad == 0.0 {
            0
        } else {
            -8
        };
        (first..=8).map(|shift| 1e-3 * f64::from(shift)).collect()
    }

    /// Computes the difference of the rolling radii over the shift without yaw and without friction: each wheel rolls
    /// on the mean radius of its elastic patches, weighted by their loads.
    ///
    /// # Errors
    /// The wheelset has no contact when centred.
    pub fn rolling_radius_difference(&self) -> Result<RollingRadiusDifference, RollingRadiusError> {
        rolling_radius::difference(self)
    }
}

/// The result of a computation that cannot fail.
fn certain<T>(result: Result<T, Infallible>) -> T {
    match result {
        Ok(value) => value,
        Err(never) => match never {},
    }
}
