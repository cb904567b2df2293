//! Density of the oil under pressure.

use crate::parameters::{Oil, OilColumn};

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
