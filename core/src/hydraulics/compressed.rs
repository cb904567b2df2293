//! Density of the oil under pressure, the limits of this law, and the force that causes the largest pressure.

use super::flow::Laws;
use crate::math::root::bracketed_root;
use crate::parameters::{Oil, OilColumn};

/// Ratio of the largest pressure to the bulk modulus (1).
///
/// The volume falls linearly with the pressure and would be zero at the bulk modulus. At half of the modulus the oil
/// has half its volume, far beyond any real damper.
const MAX_PRESSURE_RATIO: f64 = 0.5;

/// Ratio of the pressure to the bulk modulus above which the density is constant (1). Root searches also try pressures
/// above the largest allowed one.
const MAX_DENSITY_RATIO: f64 = 0.9;

/// Density law of the oil at its working temperature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Density {
    /// Density at atmospheric pressure (kg/m^3).
    without_pressure: f64,
    pub(crate) column: Option<OilColumn>,
    /// Pressure above which the density is constant (Pa).
    max_pressure_pa: f64,
}

impl Density {
    pub(super) fn new(oil: &Oil) -> Self {
        Self {
            without_pressure: oil.density_without_pressure_kg_per_m3(),
            column: oil.column,
            max_pressure_pa: oil.column.map_or(f64::INFINITY, |column| {
                MAX_DENSITY_RATIO * column.bulk_modulus_pa
            }),
        }
    }

    /// Density under a gauge pressure (kg/m^3), finite and positive at any pressure (Pa).
    #[inline(always)]
    pub(crate) fn at(&self, pressure_pa: f64) -> f64 {
        match &self.column {
            None => self.without_pressure,
            Some(column) => {
                // Unlike `min`, this takes one vector instruction.
                let pressure = if pressure_pa < self.max_pressure_pa {
                    pressure_pa
                } else {
                    self.max_pressure_pa
                };
                self.without_pressure / (1.0 - column.compression(pressure))
            }
        }
    }

    /// [`Density::at`] with the air volume at this pressure.
    #[inline(always)]
    pub(super) fn with_air(&self, pressure_pa: f64, air_volume: f64) -> f64 {
        match &self.column {
            Some(column) if pressure_pa <= self.max_pressure_pa => {
                self.without_pressure / (1.0 - column.compression_with(pressure_pa, air_volume))
            }
            _ => self.at(pressure_pa),
        }
    }
}

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
