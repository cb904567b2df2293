//! Creepages of a contact.

/// Velocity of the wheel's surface relative to the rail over the speed, in [contact axes](crate::creep).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Creepage {
    /// Longitudinal creepage, dimensionless.
    pub longitudinal: f64,
    /// Lateral creepage, dimensionless.
    pub lateral: f64,
    /// Spin: angular velocity about axis 3 over the speed, 1/m.
    pub spin_per_m: f64,
}

/// Greatest magnitude of a creepage (spin: in 1/m) that is used as it is; far beyond full sliding.
pub const MAX_CREEPAGE: f64 = 1e6;

impl Creepage {
    /// Longitudinal and lateral creepage and spin.
    #[inline(always)]
    pub(crate) fn of([longitudinal, lateral, spin_per_m]: [f64; 3]) -> Self {
        Self {
            longitudinal,
            lateral,
            spin_per_m,
        }
    }

    /// The same with every component limited to [`MAX_CREEPAGE`] in magnitude; NaN becomes zero.
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

    /// Whether no component is greater than [`MAX_CREEPAGE`], nor all together, and none is NaN.
    #[inline(always)]
    pub(super) fn is_bounded(&self) -> bool {
        let square = self.longitudinal * self.longitudinal
            + self.lateral * self.lateral
            + self.spin_per_m * self.spin_per_m;
        square <= MAX_CREEPAGE * MAX_CREEPAGE
    }

    /// Magnitude of longitudinal and lateral creepage, without spin.
    pub fn magnitude(&self) -> f64 {
        (self.longitudinal * self.longitudinal + self.lateral * self.lateral).sqrt()
    }
}
