//! Parameters of the oil and of its column.

use super::range::{allowed, parameters};

/// Absolute atmospheric pressure p_a (Pa), ISO 2533.
pub const ATMOSPHERIC_PRESSURE_PA: f64 = 101_325.0;

/// Temperature at which the oil density is given (degC), as on data sheets (ISO 3675).
pub const DENSITY_TEMPERATURE_C: f64 = 15.0;

parameters! {
    /// Oil at its working temperature.
    #[derive(Copy)]
    pub struct Oil, OilRanges {
        /// Density at 15 degC without air (kg/m^3).
        density_kg_per_m3: f64, 500 to 2000 "kg/m3";
        /// Volumetric thermal expansion (1/K).
        thermal_expansion_per_k: f64 = 0, 0 to 2e-3 "1/K";
        /// Working temperature (degC); the default is from the bench test of the source paper.
        temperature_c: f64 = 45, -60 to 150 "degC";
        /// Kinematic viscosity at 40 degC (m^2/s); the default is for ISO VG 15 damper oil.
        viscosity_40c_m2_per_s: f64 = 15e-6, 1e-6 to 1e-2 "m2/s";
        /// Kinematic viscosity at 100 degC (m^2/s); the default is for ISO VG 15 damper oil with a viscosity index of
        /// about 150.
        viscosity_100c_m2_per_s: f64 = 3.8e-6, 5e-7 to 1e-2 => "at least 5e-7 m2/s and below viscosity_40c_m2_per_s";
    }
    tables {
        /// Oil columns as springs; `None` for rigid oil.
        column: Option<OilColumn>;
    }
}

impl Oil {
    /// Rigid oil with this density (kg/m^3); every other parameter has its default.
    pub const fn new(density_kg_per_m3: f64) -> Self {
        Self {
            density_kg_per_m3,
            thermal_expansion_per_k: const { Self::RANGES.thermal_expansion_per_k.default.unwrap() },
            temperature_c: const { Self::RANGES.temperature_c.default.unwrap() },
            viscosity_40c_m2_per_s: const { Self::RANGES.viscosity_40c_m2_per_s.default.unwrap() },
            viscosity_100c_m2_per_s: const { Self::RANGES.viscosity_100c_m2_per_s.default.unwrap() },
            column: None,
        }
    }

    /// Adds the compressibility of the oil columns.
    #[must_use]
    pub const fn column(mut self, column: OilColumn) -> Self {
        self.column = Some(column);
        self
    }
}

parameters! {
    /// Compressibility of the oil column under the working pressure, with entrained air:
    /// `delta_oil(P) = (V/A) [ (1 - alpha) P/E_l + alpha (1 - (p_a/(p_a + P))^(1/n)) ]`.
    #[derive(Copy)]
    pub struct OilColumn, OilColumnRanges {
        /// Bulk modulus E_l of the oil without air (Pa).
        bulk_modulus_pa: f64, 1e8 to 1e11 "Pa";
        /// Volume of the chamber under pressure in extension (m^3).
        rod_side_volume_m3: f64, 1e-7 to 1 "m3";
        /// Volume of the chamber under pressure in compression (m^3).
        piston_side_volume_m3: f64, 1e-7 to 1 "m3";
        /// Volume ratio alpha of entrained air at atmospheric pressure (1).
        air_fraction: f64 = 0, 0 to 0.2;
        /// Polytropic exponent n of the air (1).
        polytropic_exponent: f64 = 1, 1 to 1.67;
    }
}

impl OilColumn {
    /// Oil without air: bulk modulus (Pa) and volumes (m^3) of the rod-side and the piston-side chamber.
    pub const fn new(
        bulk_modulus_pa: f64,
        rod_side_volume_m3: f64,
        piston_side_volume_m3: f64,
    ) -> Self {
        Self {
            bulk_modulus_pa,
            rod_side_volume_m3,
            piston_side_volume_m3,
            air_fraction: const { Self::RANGES.air_fraction.default.unwrap() },
            polytropic_exponent: const { Self::RANGES.polytropic_exponent.default.unwrap() },
        }
    }
}
