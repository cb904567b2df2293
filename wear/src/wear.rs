//! Volumes that a body loses, added up along its profile.

use crate::estimate::WearEstimate;
use crate::grid::{CELL_M, WearGrid};
use crate::law::WearLaw;
use crate::patch::WearingPatch;
use crate::strips::{STRIPS, strips};

/// Wear of one wheel or rail over a distance: the volume lost in each cell of its profile.
///
/// ```
/// use dashpot_rail::creep::Creepage;
/// use dashpot_rail::profile::s1002;
/// use dashpot_wear::{Wear, WearGrid, WearLaw, WearingPatch};
/// let patch = WearingPatch {
///     load_n: 100e3,
///     peak_pressure_pa: 1e9,
///     semi_axes_m: [6e-3, 8e-3],
///     creepage: Creepage { longitudinal: 1e-3, ..Creepage::default() },
///     wear_number_n: 30.0,
///     speed_m_per_s: 20.0,
///     friction: 0.3,
/// };
/// let mut wear = Wear::new(WearGrid::new(&s1002::profile()), WearLaw::default());
/// // 100 km in one go.
/// wear.add(0.0, &patch, 100e3);
/// // 100 N of load times sliding per metre: 5.5e-4 * 100 N * 100 km / 3 GPa.
/// assert!((wear.volume_m3() / 1.8333e-6 - 1.0).abs() < 1e-4);
/// let estimate = wear.of_wheel(0.46);
/// assert!((1e6 * estimate.max_depth_m - 59.5).abs() < 3.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Wear {
    grid: WearGrid,
    law: WearLaw,
    volumes_m3: Vec<f64>,
    /// Sum of wear number times distance, J.
    work_j: f64,
}

impl Wear {
    /// An unworn profile.
    pub fn new(grid: WearGrid, law: WearLaw) -> Self {
        Self {
            volumes_m3: vec![0.0; grid.cells()],
            grid,
            law,
            work_j: 0.0,
        }
    }

    /// The law.
    pub fn law(&self) -> &WearLaw {
        &self.law
    }

    /// The cells.
    pub fn grid(&self) -> &WearGrid {
        &self.grid
    }

    /// Adds the wear by a patch at the lateral position `y_m` of the profile over a rolled distance. Does not allocate;
    /// a patch without load or friction work changes nothing.
    #[inline]
    pub fn add(&mut self, y_m: f64, patch: &WearingPatch, distance_m: f64) {
        if !(patch.is_wearing() && distance_m > 0.0 && y_m.is_finite()) {
            return;
        }
        self.work_j += patch.wear_number_n * distance_m;
        let half_width_m = patch.semi_axes_m[1];
        let start_m = self.grid.arc_m(y_m) - half_width_m;
        let width_m = 2.0 * half_width_m / STRIPS as f64;
        for (k, strip) in strips(patch).iter().enumerate() {
            let volume_m3 = self.law.volume_rate_m2(patch, strip) * distance_m;
            let ends_m = [k, k + 1].map(|end| start_m + end as f64 * width_m);
            self.grid.spread(&mut self.volumes_m3, ends_m, volume_m3);
        }
    }

    /// Volume lost, m^3.
    pub fn volume_m3(&self) -> f64 {
        self.volumes_m3.iter().sum()
    }

    /// Friction work, J: the wear number integrated over the distance.
    pub fn work_j(&self) -> f64 {
        self.work_j
    }

    /// The wear of a wheel of radius `radius_m` at the tread datum, spread over its circumference.
    pub fn of_wheel(&self, radius_m: f64) -> WearEstimate {
        self.estimate(|[_, z_m]| std::f64::consts::TAU * (radius_m + z_m))
    }

    /// The wear of a rail of length `length_m`, over which the distances were rolled.
    pub fn of_rail(&self, length_m: f64) -> WearEstimate {
        self.estimate(|_| length_m)
    }

    /// The estimate for a body whose surface has the length `length_m` in the rolling direction at a point `[y, z]`.
    fn estimate(&self, length_m: impl Fn([f64; 2]) -> f64) -> WearEstimate {
        let cells = self.volumes_m3.iter().enumerate().map(|(cell, volume_m3)| {
            let at = self.grid.middle_m(cell);
            (at, volume_m3 / (length_m(at) * CELL_M))
        });
        WearEstimate::new(&self.law, cells, self.volume_m3())
    }
}
