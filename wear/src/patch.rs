//! A contact patch as the wear laws need it.

use dashpot_rail::contact::{PatchForces, STANDSTILL_SPEED_M_PER_S};
use dashpot_rail::creep::Creepage;

/// A contact patch that slides: load, size, creepages and friction work.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearingPatch {
    /// Normal load, N.
    pub load_n: f64,
    /// Maximum pressure, Pa.
    pub peak_pressure_pa: f64,
    /// Semi-axes `[a, b]` in the rolling direction and across, m.
    pub semi_axes_m: [f64; 2],
    /// Creepages.
    pub creepage: Creepage,
    /// Wear number `T gamma`, N: power dissipated by friction divided by the speed.
    pub wear_number_n: f64,
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Friction coefficient, dimensionless.
    pub friction: f64,
}

impl WearingPatch {
    /// The patch of a wheel that runs at `speed_m_per_s` with the friction coefficient `friction`.
    #[inline]
    pub fn new(patch: &PatchForces, speed_m_per_s: f64, friction: f64) -> Self {
        let speed_m_per_s = libm::hypot(speed_m_per_s, STANDSTILL_SPEED_M_PER_S);
        Self {
            load_n: patch.load_n,
            peak_pressure_pa: patch.peak_pressure_pa,
            semi_axes_m: patch.semi_axes_m,
            creepage: patch.creepage,
            wear_number_n: patch.dissipation_w / speed_m_per_s,
            speed_m_per_s,
            friction,
        }
    }

    /// Area of an ellipse with this load and maximum pressure, `3 N / (2 p0)`, m^2; a part of a patch has its part of
    /// the area.
    #[inline]
    pub fn area_m2(&self) -> f64 {
        if self.peak_pressure_pa > 0.0 {
            1.5 * self.load_n / self.peak_pressure_pa
        } else {
            0.0
        }
    }

    /// True if the patch loses material: it has load, size, friction and friction work, and every number is finite.
    #[inline]
    pub fn is_wearing(&self) -> bool {
        let [a, b] = self.semi_axes_m;
        let is_positive = |number: f64| number > 0.0 && number.is_finite();
        [
            self.load_n,
            self.peak_pressure_pa,
            a,
            b,
            self.wear_number_n,
            self.friction,
        ]
        .into_iter()
        .all(is_positive)
            && self.speed_m_per_s.is_finite()
    }
}
