//! Oil at its working temperature: density, viscosity and the oil column as a spring.

use crate::math::elementary::{log10, pow};
use crate::parameters::{ATMOSPHERIC_PRESSURE_PA, DENSITY_TEMPERATURE_C, Oil, OilColumn};

/// 0 degC in kelvin.
pub(crate) const ZERO_CELSIUS_K: f64 = 273.15;

/// Specific gas constant of dry air (J/(kg K)), ISO 2533.
const AIR_GAS_CONSTANT: f64 = 287.053;

impl Oil {
    /// Density (kg/m^3) of oil with entrained air under a gauge pressure (Pa).
    ///
    /// Mass balance: `rho = [(1 - alpha) rho_oil + alpha rho_air] / V(P)`, where V is the ratio of the volume to the
    /// volume at atmospheric pressure.
    ///
    /// ```
    /// use dashpot_core::parameters::Oil;
    /// let oil = Oil::new(870.0).thermal_expansion_per_k(7e-4); // at 45 degC
    /// assert!((oil.density_kg_per_m3(0.0) - 870.0 / 1.021).abs() < 1e-9);
    /// ```
    pub fn density_kg_per_m3(&self, pressure_pa: f64) -> f64 {
        let density = self.density_without_pressure_kg_per_m3();
        match &self.column {
            None => density,
            Some(column) => density / (1.0 - column.compression(pressure_pa)),
        }
    }

    /// Density (kg/m^3) of oil with entrained air at atmospheric pressure.
    pub(crate) fn density_without_pressure_kg_per_m3(&self) -> f64 {
        let warming = self.temperature_c - DENSITY_TEMPERATURE_C;
        let oil = self.density_kg_per_m3 / (1.0 + self.thermal_expansion_per_k * warming);
        let Some(column) = &self.column else {
            return oil;
        };
        let alpha = column.air_fraction;
        let air =
            ATMOSPHERIC_PRESSURE_PA / (AIR_GAS_CONSTANT * (self.temperature_c + ZERO_CELSIUS_K));
        (1.0 - alpha) * oil + alpha * air
    }

    /// Kinematic viscosity at the working temperature (m^2/s).
    ///
    /// Walther's law (ASTM D341) through the two given points: `log10(log10(nu + 0.7)) = A - B log10(T)`, nu in mm^2/s
    /// and T in K.
    pub fn kinematic_viscosity_m2_per_s(&self) -> f64 {
        let ordinate = |viscosity: f64| log10(log10(viscosity * 1e6 + 0.7));
        let abscissa = |celsius: f64| log10(celsius + ZERO_CELSIUS_K);
        let (y40, y100) = (
            ordinate(self.viscosity_40c_m2_per_s),
            ordinate(self.viscosity_100c_m2_per_s),
        );
        let slope = (y100 - y40) / (abscissa(100.0) - abscissa(40.0));
        let y = y40 + slope * (abscissa(self.temperature_c) - abscissa(40.0));
        (pow(10.0, pow(10.0, y)) - 0.7) * 1e-6
    }
}

impl OilColumn {
    /// Loss of volume of the mixture under a gauge pressure P (Pa), relative to its volume at atmospheric pressure:
    /// `(1 - alpha) P/E_l + alpha (1 - (p_a/(p_a + P))^(1/n))` (1).
    pub fn compression(&self, pressure_pa: f64) -> f64 {
        self.compression_with(pressure_pa, self.air_volume(pressure_pa))
    }

    /// [`OilColumn::compression`] with the air volume at this pressure.
    pub(crate) fn compression_with(&self, pressure_pa: f64, air_volume: f64) -> f64 {
        (1.0 - self.air_fraction) * pressure_pa / self.bulk_modulus_pa
            + self.air_fraction * (1.0 - air_volume)
    }

    /// Ratio of the volume of the air to its volume at atmospheric pressure, `(p_a/(p_a + P))^(1/n)` (1).
    pub(crate) fn air_volume(&self, pressure_pa: f64) -> f64 {
        let ratio = ATMOSPHERIC_PRESSURE_PA / (ATMOSPHERIC_PRESSURE_PA + pressure_pa);
        if self.polytropic_exponent == 1.0 {
            ratio
        } else {
            pow(ratio, 1.0 / self.polytropic_exponent)
        }
    }

    /// Derivative of [`OilColumn::compression`] with respect to pressure (1/Pa).
    pub fn compressibility_per_pa(&self, pressure_pa: f64) -> f64 {
        self.compressibility_with(pressure_pa, self.air_volume(pressure_pa))
    }

    /// [`OilColumn::compressibility_per_pa`] with the air volume at this pressure.
    pub(crate) fn compressibility_with(&self, pressure_pa: f64, air_volume: f64) -> f64 {
        let absolute = ATMOSPHERIC_PRESSURE_PA + pressure_pa;
        (1.0 - self.air_fraction) / self.bulk_modulus_pa
            + self.air_fraction * air_volume / (self.polytropic_exponent * absolute)
    }

    /// Bulk modulus of the mixture (Pa) at an absolute pressure p (Pa): its volume divided by its compressibility, `E =
    /// E_l (1 + alpha (p_a/p)^(1/n)) / (1 + alpha p_a^(1/n) E_l/(n p^((n+1)/n)))` to first order in alpha.
    ///
    /// ```
    /// use dashpot_core::parameters::OilColumn;
    /// let column = OilColumn::new(1.5e9, 1e-3, 1e-3);
    /// assert!((column.bulk_modulus_pa(101_325.0) / 1.5e9 - 1.0).abs() < 1e-12);
    /// ```
    pub fn bulk_modulus_pa(&self, absolute_pressure_pa: f64) -> f64 {
        let gauge = absolute_pressure_pa - ATMOSPHERIC_PRESSURE_PA;
        (1.0 - self.compression(gauge)) / self.compressibility_per_pa(gauge)
    }
}
