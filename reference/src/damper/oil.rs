//! Density and viscosity of the oil at its working temperature, and shortening of an oil column.

use dashpot_core::parameters::{ATMOSPHERIC_PRESSURE_PA, DENSITY_TEMPERATURE_C, Oil, OilColumn};

/// Gas constant of dry air (J/(kg K)), ISO 2533.
const AIR_GAS_CONSTANT: f64 = 287.052_87;
/// 0 degC (K).
const ZERO_CELSIUS_K: f64 = 273.15;

/// Absolute temperature (K) of a temperature in degC.
pub(super) fn kelvin(celsius: f64) -> f64 {
    celsius + ZERO_CELSIUS_K
}

/// Minimum volume of oil and air, relative to the volume at atmospheric pressure (1).
const MIN_VOLUME: f64 = 0.05;

/// Density and viscosity as functions of gauge pressure at one temperature.
#[derive(Clone, Debug)]
pub(super) struct Fluid {
    /// Density of the oil without air at atmospheric pressure (kg/m^3).
    oil_density: f64,
    /// Density of air at atmospheric pressure (kg/m^3).
    air_density: f64,
    column: Option<OilColumn>,
    /// Kinematic viscosity (m^2/s).
    pub(super) viscosity: f64,
}

impl Fluid {
    pub(super) fn new(oil: &Oil) -> Self {
        let rise = oil.temperature_c - DENSITY_TEMPERATURE_C;
        Self {
            oil_density: oil.density_kg_per_m3 / (1.0 + oil.thermal_expansion_per_k * rise),
            air_density: ATMOSPHERIC_PRESSURE_PA / (AIR_GAS_CONSTANT * kelvin(oil.temperature_c)),
            column: oil.column,
            viscosity: walther(oil),
        }
    }

    /// Density of oil and entrained air (kg/m^3) at a gauge pressure (Pa): the mass of a unit volume at atmospheric
    /// pressure, divided by its volume at `pressure`.
    pub(super) fn density(&self, pressure: f64) -> f64 {
        let Some(column) = &self.column else {
            return self.oil_density;
        };
        let air = column.air_fraction;
        let mass = (1.0 - air) * self.oil_density + air * self.air_density;
        let volume = (1.0 - air) * (1.0 - pressure / column.bulk_modulus_pa)
            + air * air_volume_ratio(column, pressure);
        // Valid parameters stay above the bound; only trial pressures of a root search reach it.
        mass / volume.max(MIN_VOLUME)
    }
}

/// Volume of air at gauge pressure over its volume at atmospheric pressure,
/// `(p_a/(p_a + P))^(1/n)`.
fn air_volume_ratio(column: &OilColumn, pressure: f64) -> f64 {
    (ATMOSPHERIC_PRESSURE_PA / (ATMOSPHERIC_PRESSURE_PA + pressure))
        .powf(1.0 / column.polytropic_exponent)
}

/// Kinematic viscosity (m^2/s) at the working temperature, ASTM D341: `log10 log10 (nu + 0.7)` is linear in `log10 T`
/// through the points at 40 and 100 degC, with nu in mm^2/s and T in K.
fn walther(oil: &Oil) -> f64 {
    let double_log = |nu: f64| (nu * 1e6 + 0.7).log10().log10();
    let (cold, hot) = (kelvin(40.0).log10(), kelvin(100.0).log10());
    let (at_cold, at_hot) = (
        double_log(oil.viscosity_40c_m2_per_s),
        double_log(oil.viscosity_100c_m2_per_s),
    );
    let along = (kelvin(oil.temperature_c).log10() - cold) / (hot - cold);
    let value = at_cold + along * (at_hot - at_cold);
    (10f64.powf(10f64.powf(value)) - 0.7) * 1e-6
}

/// One oil column as a spring under gauge pressure.
#[derive(Clone, Debug)]
pub(super) struct ColumnSpring {
    /// Chamber volume over piston area (m).
    length: f64,
    column: OilColumn,
}

impl ColumnSpring {
    pub(super) fn new(column: OilColumn, volume: f64, area: f64) -> Self {
        Self {
            length: volume / area,
            column,
        }
    }

    /// Shortening (m) under gauge pressure (Pa).
    pub(super) fn shortening(&self, pressure: f64) -> f64 {
        let air = self.column.air_fraction;
        self.length
            * ((1.0 - air) * pressure / self.column.bulk_modulus_pa
                + air * (1.0 - air_volume_ratio(&self.column, pressure)))
    }

    /// Shortening per pressure (m/Pa) at gauge pressure (Pa).
    pub(super) fn compliance(&self, pressure: f64) -> f64 {
        let air = self.column.air_fraction;
        let exponent = self.column.polytropic_exponent;
        self.length
            * ((1.0 - air) / self.column.bulk_modulus_pa
                + air * air_volume_ratio(&self.column, pressure)
                    / (exponent * (ATMOSPHERIC_PRESSURE_PA + pressure)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oil(temperature_c: f64) -> Oil {
        Oil::new(870.0)
            .thermal_expansion_per_k(7e-4)
            .temperature_c(temperature_c)
            .viscosity_40c_m2_per_s(15e-6)
            .viscosity_100c_m2_per_s(3.8e-6)
            .column(OilColumn::new(1.5e9, 0.5e-3, 0.6e-3).air_fraction(0.005))
    }

    /// Both data points, and independently computed values of the D341 line at 45 and 60 degC.
    #[test]
    fn viscosity_follows_the_d341_line() {
        for (temperature, expected) in [
            (40.0, 15e-6),
            (45.0, 1.286_125_742_976_544_6e-5),
            (60.0, 8.545_099_407_905_419e-6),
            (100.0, 3.8e-6),
        ] {
            let ours = walther(&oil(temperature));
            assert!(
                (ours / expected - 1.0).abs() < 1e-12,
                "{temperature}: {ours}"
            );
        }
    }

    /// Independently computed values of the mass balance at 45 degC.
    #[test]
    fn density_follows_the_mass_balance() {
        let fluid = Fluid::new(&oil(45.0));
        for (pressure, expected) in [(0.0, 847.850_797_197_468_3), (5e6, 854.875_612_934_214_7)] {
            let ours = fluid.density(pressure);
            assert!((ours / expected - 1.0).abs() < 1e-12, "{pressure}: {ours}");
        }
    }

    /// Tangent modulus `E` of oil with air at the absolute pressure p, in its usual form, in which the air ratio is
    /// relative to the volume of the oil.
    #[test]
    fn column_compliance_is_the_tangent_modulus() {
        let column = oil(45.0).column.expect("a column");
        let spring = ColumnSpring::new(column, 0.5e-3, 3.2e-3);
        let ratio = column.air_fraction / (1.0 - column.air_fraction);
        let (modulus, atmosphere) = (column.bulk_modulus_pa, ATMOSPHERIC_PRESSURE_PA);
        for gauge in [0.0, 1e5, 1e6, 1e7] {
            let p = gauge + atmosphere;
            // Loss of volume per pressure, relative to the volume at atmospheric pressure.
            let lost = (1.0 + ratio * atmosphere * modulus / (p * p)) / modulus / (1.0 + ratio);
            let ours = spring.compliance(gauge) * 3.2e-3 / 0.5e-3;
            assert!((ours / lost - 1.0).abs() < 1e-12, "{gauge}: {ours} {lost}");
            let step = 1e-3 * p;
            let chord =
                (spring.shortening(gauge + step) - spring.shortening(gauge - step)) / (2.0 * step);
            assert!((chord / spring.compliance(gauge) - 1.0).abs() < 1e-5);
        }
    }
}
