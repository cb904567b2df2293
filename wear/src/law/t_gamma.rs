//! Wear rate over the friction work per contact area, of the University of Sheffield.
//!
//! Twin-disc tests of wheel steel R8T on rail steel UIC 60 900A (Lewis and Dwyer-Joyce, Proc. IMechE J 218 (2004)
//! 467-478; Braghin, Lewis, Dwyer-Joyce and Bruni, "A mathematical model to predict railway wheel profile evolution due
//! to wear", Wear 261 (2006) 1253-1264). With the wear number `T gamma` of a patch and its area `A`, the mass lost per
//! metre rolled and mm^2 of contact is, in ug/(m mm^2) over `T gamma / A` in N/mm^2: `5.3 T gamma / A` up to 10.4
//! (mild), 55.0 up to 77.2 (severe), and beyond it rises by 61.9 per N/mm^2 (catastrophic). The tests were dry, on
//! discs of 47 mm diameter. The rate is that of the wheel; the softer rail steel of the tests wore more.

use crate::patch::WearingPatch;
use crate::strips::Strip;

/// Wear rate over the friction work per contact area.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TGamma {
    /// Density of steel, kg/m^3.
    pub density_kg_per_m3: f64,
}

impl Default for TGamma {
    /// Steel of 7850 kg/m^3.
    fn default() -> Self {
        Self {
            density_kg_per_m3: 7850.0,
        }
    }
}

/// Ends of mild and severe wear, N/m^2.
const ENDS: [f64; 2] = [10.4e6, 77.2e6];
/// Mass per metre rolled and contact area: slope of mild wear, kg/(m N); severe wear, kg/m^3; slope beyond, kg/(m N).
/// One ug/(m mm^2) is 1e-3 kg/(m m^2).
const MILD: f64 = 5.3e-9;
const SEVERE: f64 = 55.0e-3;
const CATASTROPHIC: f64 = 61.9e-9;

impl TGamma {
    /// Mass lost per metre rolled and contact area, kg/m^3, at a wear number per contact area, N/m^2.
    ///
    /// ```
    /// use dashpot_wear::TGamma;
    /// // 5 N/mm^2: 26.5 ug/(m mm^2); 40 N/mm^2: 55 ug/(m mm^2).
    /// assert!((TGamma::mass_rate_kg_per_m3(5e6) - 26.5e-3).abs() < 1e-12);
    /// assert!((TGamma::mass_rate_kg_per_m3(40e6) - 55e-3).abs() < 1e-12);
    /// ```
    #[inline]
    pub fn mass_rate_kg_per_m3(work_per_area_n_per_m2: f64) -> f64 {
        let work = work_per_area_n_per_m2;
        if work < ENDS[0] {
            MILD * work
        } else if work <= ENDS[1] {
            SEVERE
        } else {
            SEVERE + CATASTROPHIC * (work - ENDS[1])
        }
    }

    /// The regime is that of the whole patch, as in the tests; strips share the loss in proportion to their work.
    #[inline]
    pub(super) fn volume_rate_m2(&self, patch: &WearingPatch, strip: &Strip) -> f64 {
        let area = patch.area_m2();
        if area <= 0.0 || patch.wear_number_n <= 0.0 {
            return 0.0;
        }
        let mass = Self::mass_rate_kg_per_m3(patch.wear_number_n / area) * area;
        mass / self.density_kg_per_m3 * strip.work_n / patch.wear_number_n
    }
}
