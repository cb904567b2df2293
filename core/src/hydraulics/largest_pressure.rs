//! The force that causes the largest pressure.

use super::flow::Laws;
use crate::math::root::bracketed_root;

/// Ratio of the largest pressure to the bulk modulus (1).
///
/// The volume falls linearly with the pressure and would be zero at the bulk modulus. At half of the modulus the oil
/// has half its volume, far beyond any real damper.
const MAX_PRESSURE_RATIO: f64 = 0.5;

impl Laws {
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
        self.density.column.map(|column| column.bulk_modulus_pa)
    }

    /// Force on the oil (N) in compression with two chambers, at a pressure of the piston side (Pa).
    fn two_chamber_force(&self, vapour_pressure_pa: f64, pressure_pa: f64) -> f64 {
        let (rod_side, rod) = (self.rod_side_area, self.rod_area());
        let density = self.density.at(pressure_pa);
        let [foot] = self.through_foot([pressure_pa], [density]);
        let foot = foot * rod_side;
        // The pressure of the rod side cannot fall below the vapour pressure.
        let max_difference = pressure_pa - vapour_pressure_pa;
        let difference = bracketed_root(0.0, max_difference, |difference| {
            let [piston] = self.through_piston(true, [difference], [density]);
            piston * rod - foot
        });
        pressure_pa * rod + difference * rod_side
    }
}
