//! How far the law of the oil's density goes: the pressures it represents, and the force that makes them.

use super::flow::Laws;
use crate::build::root::bracketed_root;

/// Largest pressure over the bulk modulus (1). The volume falls linearly with the pressure and is zero at the bulk
/// modulus itself; at half of it the oil is already at half its volume, far beyond any real damper.
const LARGEST_PRESSURE_RATIO: f64 = 0.5;

/// A root is searched beyond the largest pressure too. There the density stays what it is at this ratio.
const SEARCHED_PRESSURE_RATIO: f64 = 0.9;

impl Laws {
    /// Density of the oil (kg/m^3) under gauge pressure (Pa): finite and positive at any pressure.
    pub(crate) fn density_kg_per_m3(&self, pressure_pa: f64) -> f64 {
        let highest = self
            .bulk_modulus_pa()
            .map_or(f64::INFINITY, |modulus| SEARCHED_PRESSURE_RATIO * modulus);
        self.oil.density_kg_per_m3(pressure_pa.min(highest))
    }

    /// Largest force (N) under which no chamber has more than [`LARGEST_PRESSURE_RATIO`] of the bulk modulus; `None`
    /// for rigid oil.
    pub(crate) fn largest_force_n(&self) -> Option<f64> {
        let pressure = LARGEST_PRESSURE_RATIO * self.bulk_modulus_pa()?;
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

    /// Force on the oil (N) in compression with two chambers, the piston side at a pressure (Pa).
    fn two_chamber_force(&self, vapour_pressure_pa: f64, pressure_pa: f64) -> f64 {
        let (rod_side, rod) = (self.rod_side_area, self.rod_area());
        let foot = self.through_foot(pressure_pa) * rod_side;
        // The rod side cannot fall below the vapour pressure.
        let most = pressure_pa - vapour_pressure_pa;
        let difference = bracketed_root(0.0, most, |difference| {
            self.through_piston(true, difference, pressure_pa) * rod - foot
        });
        pressure_pa * rod + difference * rod_side
    }
}
