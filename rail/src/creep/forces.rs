//! Creep forces on the wheel.

use super::creepage::Creepage;

/// Creep forces on the wheel, in [contact axes](crate::creep).
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CreepForces {
    /// Force in the rolling direction, N.
    pub longitudinal_n: f64,
    /// Force along the common tangent to the field side, N.
    pub lateral_n: f64,
    /// Spin moment about axis 3, N m.
    pub moment_n_m: f64,
}

impl CreepForces {
    /// Returns `[longitudinal force, lateral force, moment]`, N and N m.
    #[inline]
    pub fn components(&self) -> [f64; 3] {
        [self.longitudinal_n, self.lateral_n, self.moment_n_m]
    }

    /// Forces with components `[longitudinal force, lateral force, moment]`, N and N m.
    #[inline(always)]
    pub(crate) fn of_components([longitudinal_n, lateral_n, moment_n_m]: [f64; 3]) -> Self {
        Self {
            longitudinal_n,
            lateral_n,
            moment_n_m,
        }
    }

    /// Multiplies forces and moment by `factor`.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        Self::of_components(self.components().map(|component| component * factor))
    }

    /// Magnitude of the tangential force, N.
    pub fn magnitude_n(&self) -> f64 {
        (self.longitudinal_n * self.longitudinal_n + self.lateral_n * self.lateral_n).sqrt()
    }

    /// Dissipated power divided by the speed, N: `-(Fx xi + Fy eta + M phi)`; positive if energy is dissipated.
    pub fn dissipation_n(&self, creepage: &Creepage) -> f64 {
        -(self.longitudinal_n * creepage.longitudinal
            + self.lateral_n * creepage.lateral
            + self.moment_n_m * creepage.spin_per_m)
    }
}
