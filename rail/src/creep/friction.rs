//! Friction coefficient as a function of the sliding speed.

use crate::setters::setters;

/// Friction that falls with the sliding speed `w`: `mu(w) = mu0 ((1 - r) exp(-w / w0) + r)` (Polach, Wear 258, 2005,
/// 992-1000).
///
/// If the coefficient is zero, negative or NaN, there are no creep forces.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Friction {
    /// `mu0`: coefficient at zero sliding speed, dimensionless.
    pub static_coefficient: f64,
    /// `r`: ratio of the coefficients at infinite and zero sliding speed, 0 to 1; 1 for constant friction.
    pub residual_ratio: f64,
    /// `w0`: sliding speed at which the falling part has dropped to 1/e, positive, m/s.
    pub decay_speed_m_per_s: f64,
}

impl Default for Friction {
    /// Dry rail: 0.4 at every sliding speed.
    fn default() -> Self {
        Self::constant(0.4)
    }
}

/// Errors in a [`Friction`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrictionError {
    /// A quantity is out of bounds.
    #[error("{name}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the quantity.
        name: &'static str,
        /// Its value, in m/s for the decay speed, else dimensionless.
        value: f64,
        /// Minimum and maximum allowed value.
        allowed: [f64; 2],
    },
}

impl Friction {
    /// The same coefficient at every sliding speed.
    ///
    /// ```
    /// use dashpot_rail::creep::Friction;
    /// assert_eq!(Friction::constant(0.3).at(5.0), 0.3);
    /// ```
    pub const fn constant(coefficient: f64) -> Self {
        Self {
            static_coefficient: coefficient,
            residual_ratio: 1.0,
            decay_speed_m_per_s: 1.0,
        }
    }

    setters! {
        with_static_coefficient sets static_coefficient: f64;
        with_residual_ratio sets residual_ratio: f64;
        with_decay_speed_m_per_s sets decay_speed_m_per_s: f64;
    }

    /// Checks that every quantity is within its bounds.
    ///
    /// # Errors
    /// The coefficient is not within 0 to 2, the ratio not within 0 to 1, or the decay speed not within 0.001 to 1000
    /// m/s.
    pub fn check(&self) -> Result<(), FrictionError> {
        let allowed = [
            (
                "static friction coefficient",
                self.static_coefficient,
                [0.0, 2.0],
            ),
            ("residual friction ratio", self.residual_ratio, [0.0, 1.0]),
            (
                "friction decay speed",
                self.decay_speed_m_per_s,
                [1e-3, 1e3],
            ),
        ];
        for (name, value, allowed) in allowed {
            if !(allowed[0]..=allowed[1]).contains(&value) {
                return Err(FrictionError::OutOfBounds {
                    name,
                    value,
                    allowed,
                });
            }
        }
        Ok(())
    }

    /// True if the coefficient is the same at every sliding speed.
    #[inline(always)]
    pub(crate) fn is_constant(&self) -> bool {
        self.residual_ratio >= 1.0
    }

    /// Derivative of the coefficient with respect to the sliding speed, s/m.
    #[inline]
    pub(crate) fn slope_at(&self, sliding_speed_m_per_s: f64) -> f64 {
        let residual = self.static_coefficient * self.residual_ratio;
        (residual - self.at(sliding_speed_m_per_s)) / self.decay_speed_m_per_s
    }

    /// Coefficient at a sliding speed in m/s, dimensionless.
    ///
    /// ```
    /// use dashpot_rail::creep::Friction;
    /// let falling = Friction::constant(0.36).with_residual_ratio(0.4).with_decay_speed_m_per_s(2.0);
    /// assert_eq!(falling.at(0.0), 0.36);
    /// assert!((falling.at(100.0) - 0.144).abs() < 1e-12);
    /// ```
    #[inline]
    pub fn at(&self, sliding_speed_m_per_s: f64) -> f64 {
        if self.is_constant() {
            self.static_coefficient
        } else {
            self.static_coefficient
                * ((1.0 - self.residual_ratio)
                    * libm::exp(-sliding_speed_m_per_s / self.decay_speed_m_per_s)
                    + self.residual_ratio)
        }
    }
}
