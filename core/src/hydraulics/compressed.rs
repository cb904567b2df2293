//! Limits of the density law of the oil: the largest pressure and the force that causes it.

use super::flow::Laws;
use crate::math::root::bracketed_root;

/// Ratio of the largest pressure to the bulk modulus (1).
///
/// The volume falls linearly with the pressure and would be zero at the bulk modulus. At half of the modulus the oil
/// has half its volume, far beyond any real damper.
const MAX_PRESSURE_RATIO: f64 = 0.5;

/// Ratio of the pressure to the bulk modulus above which the density is constant (1). Root searches also try pressures
/// above the largest allowed one.
const MAX_DENSITY_RATIO: f64 = 0.9;

impl Laws {
    /// Density of the oil under a gauge pressure (kg/m^3), finite and positive at any pressure (Pa).
    pub(crate) fn density_kg_per_m3(&self, pressure_pa: f64) -> f64 {
        let highest = self
            .bulk_modulus_pa()
            .map_or(f64::INFINITY, |modulus| MAX_DENSITY_RATIO * modulus);
        self.oil.density_kg_per_m3(pressure_pa.min(highest))
    }

    /// Largest force (N) at which no chamber pressure exceeds [`MAX_PRESSURE_RATIO`] of the bulk modulus; `None`
    /// for rigid oil.
    pub(crate) fn max_force_n(&self) -> Option<f64> {
        let pressure = MAX_PRESSURE_RATIO * self.bulk_modulus_pa()?;
        let extension = pressure * self.rod_side_area;
        let compression = self
            .vapour_pressure_pa
            .map_or(pressure * self.piston_area, |vapour| {
                self.two_chamber_force(vapour, pressure)
            });
        Some(self.friction_n + extension.min(compression))
    }

    fn bulk_modulus_pa(&self) -> Option<f64> {
        self.oil.column.map(|column| column.bulk_modulus_pa)
    }

    /// Force on the oil (N) in compression with two chambers, at a pressure of the piston side (Pa).
    fn two_chamber_force(&self, vapour_pressure_pa: f64, pressure_pa: f64) -> f64 {
        let (rod_side, rod) = (self.rod_side_area, self.rod_area());
        let foot = self.through_foot(pressure_pa) * rod_side;
        // The pressure of the rod side cannot fall below the vapour pressure.
        let max_difference = pressure_pa - vapour_pressure_pa;
        let difference = bracketed_root(0.0, max_difference, |difference| {
            self.through_piston(true, difference, pressure_pa) * rod - foot
        });
        pressure_pa * rod + difference * rod_side
    }
}
