//! Creepages of a contact.

/// Velocity of the wheel's surface relative to the rail divided by the speed, in [contact axes](crate::creep).
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Creepage {
    /// Longitudinal creepage, dimensionless.
    pub longitudinal: f64,
    /// Lateral creepage, dimensionless.
    pub lateral: f64,
    /// Spin: angular velocity about axis 3 divided by the speed, 1/m.
    pub spin_per_m: f64,
}

/// Maximum magnitude of a creepage (spin in 1/m), far beyond full sliding; larger creepages are limited to it.
pub const MAX_CREEPAGE: f64 = 1e6;

impl Creepage {
    /// Creepage with components `[longitudinal, lateral, spin]`.
    #[inline(always)]
    pub(crate) fn of([longitudinal, lateral, spin_per_m]: [f64; 3]) -> Self {
        Self {
            longitudinal,
            lateral,
            spin_per_m,
        }
    }

    /// Limits the magnitude of every component to [`MAX_CREEPAGE`]; NaN becomes zero.
    ///
    /// ```
    /// use dashpot_rail::creep::Creepage;
    /// let bounded = Creepage { longitudinal: f64::NAN, lateral: 1e9, spin_per_m: 0.1 }.bounded();
    /// assert_eq!(bounded, Creepage { longitudinal: 0.0, lateral: 1e6, spin_per_m: 0.1 });
    /// ```
    #[inline]
    pub fn bounded(self) -> Self {
        if self.is_bounded() {
            return self;
        }
        let bound = |x: f64| {
            if x.is_nan() {
                0.0
            } else {
                x.clamp(-MAX_CREEPAGE, MAX_CREEPAGE)
            }
        };
        Self {
            longitudinal: bound(self.longitudinal),
            lateral: bound(self.lateral),
            spin_per_m: bound(self.spin_per_m),
        }
    }

    /// True if the root sum of squares of the components is at most [`MAX_CREEPAGE`], and none is NaN.
    #[inline(always)]
    pub(super) fn is_bounded(&self) -> bool {
        let square = self.longitudinal * self.longitudinal
            + self.lateral * self.lateral
            + self.spin_per_m * self.spin_per_m;
        square <= MAX_CREEPAGE * MAX_CREEPAGE
    }

    /// Resultant of longitudinal and lateral creepage, without spin.
    pub fn magnitude(&self) -> f64 {
        (self.longitudinal * self.longitudinal + self.lateral * self.lateral).sqrt()
    }
}
