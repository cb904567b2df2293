//! Archard's law with the wear chart of KTH.
//!
//! `V = k N s / H`: volume, wear coefficient, normal load, sliding distance, hardness (Archard 1953). The coefficient
//! depends on the pressure and on the sliding speed (Jendel, "Prediction of wheel profile wear: comparisons with field
//! measurements", Wear 253 (2002) 89-99). The chart was measured with pin on disc and disc on disc, dry, up to 1 m/s.

use crate::patch::WearingPatch;
use crate::strips::Strip;

/// Archard's law with coefficients over pressure and sliding speed. The chart states a range for each; the defaults
/// are the middles of the ranges.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Archard {
    /// Hardness of the softer body, Pa.
    pub hardness_pa: f64,
    /// Coefficient below [`SLOW_M_PER_S`](Self::SLOW_M_PER_S), mild wear; chart: 1e-4 to 10e-4.
    pub slow: f64,
    /// Coefficient at speeds in between, severe wear; chart: 30e-4 to 40e-4.
    pub medium: f64,
    /// Coefficient above [`FAST_M_PER_S`](Self::FAST_M_PER_S), mild wear by oxidation; chart: 1e-4 to 10e-4.
    pub fast: f64,
    /// Coefficient above [`SEIZING_PART`](Self::SEIZING_PART) of the hardness, seizure; chart: 300e-4 to 400e-4.
    pub seizing: f64,
}

impl Default for Archard {
    /// Hardness 3 GPa; coefficients 5.5e-4, 35e-4, 5.5e-4 and 350e-4.
    fn default() -> Self {
        Self {
            hardness_pa: 3e9,
            slow: 5.5e-4,
            medium: 35e-4,
            fast: 5.5e-4,
            seizing: 350e-4,
        }
    }
}

impl Archard {
    /// Sliding speed below which wear is mild, m/s.
    pub const SLOW_M_PER_S: f64 = 0.2;
    /// Sliding speed above which wear is mild again, m/s.
    pub const FAST_M_PER_S: f64 = 0.7;
    /// Pressure above which the surfaces seize, as a part of the hardness.
    pub const SEIZING_PART: f64 = 0.8;

    /// Wear coefficient at a pressure (Pa) and a sliding speed (m/s), dimensionless.
    ///
    /// ```
    /// use dashpot_wear::Archard;
    /// let law = Archard::default();
    /// assert_eq!(law.coefficient(1e9, 0.1), 5.5e-4);
    /// assert_eq!(law.coefficient(1e9, 0.5), 35e-4);
    /// assert_eq!(law.coefficient(1e9, 0.9), 5.5e-4);
    /// assert_eq!(law.coefficient(2.5e9, 0.1), 350e-4);
    /// ```
    #[inline]
    pub fn coefficient(&self, pressure_pa: f64, sliding_m_per_s: f64) -> f64 {
        if pressure_pa > Self::SEIZING_PART * self.hardness_pa {
            self.seizing
        } else if sliding_m_per_s < Self::SLOW_M_PER_S {
            self.slow
        } else if sliding_m_per_s <= Self::FAST_M_PER_S {
            self.medium
        } else {
            self.fast
        }
    }

    /// Volume worn off by a load (N) over a sliding distance (m) at a pressure (Pa) and a sliding speed (m/s), m^3.
    ///
    /// ```
    /// use dashpot_wear::Archard;
    /// // 100 N at 0.1 m/s over 1 km on steel of 3 GPa: 18.3 mm^3.
    /// let volume_m3 = Archard::default().volume_m3(100.0, 1e3, 1e9, 0.1);
    /// assert!((volume_m3 / 18.333e-9 - 1.0).abs() < 1e-4);
    /// ```
    pub fn volume_m3(
        &self,
        load_n: f64,
        sliding_m: f64,
        pressure_pa: f64,
        sliding_m_per_s: f64,
    ) -> f64 {
        self.coefficient(pressure_pa, sliding_m_per_s) * load_n * sliding_m / self.hardness_pa
    }

    /// Only the part of a patch that slides is worn, and there the shear stress is the friction coefficient times the
    /// pressure. The integral of pressure times sliding is therefore the friction work divided by the coefficient.
    #[inline]
    pub(super) fn volume_rate_m2(&self, patch: &WearingPatch, strip: &Strip) -> f64 {
        let sliding_m_per_s = strip.slip * patch.speed_m_per_s;
        let load_times_slip = strip.work_n / patch.friction;
        self.coefficient(strip.pressure_pa, sliding_m_per_s) * load_times_slip / self.hardness_pa
    }
}
