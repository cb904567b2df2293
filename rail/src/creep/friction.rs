//! Friction coefficient and its fall with the sliding speed.

/// `mu(w) = mu0 ((1 - r) exp(-w / w0) + r)` over the sliding speed `w` (Polach, Wear 258, 2005, 992-1000).
///
/// A coefficient that is zero, negative or NaN gives no creep forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// `mu0`: coefficient at zero sliding speed, dimensionless.
    pub static_coefficient: f64,
    /// `r`: coefficient at infinite sliding speed over `static_coefficient`, 0 to 1; 1 for constant friction.
    pub residual_ratio: f64,
    /// `w0`: sliding speed over which the falling part drops to 1/e, positive, m/s.
    pub decay_speed_m_per_s: f64,
}

impl Default for Friction {
    /// Dry rail: 0.4 at every sliding speed.
    fn default() -> Self {
        Self {
            static_coefficient: 0.4,
            residual_ratio: 1.0,
            decay_speed_m_per_s: 1.0,
        }
    }
}

impl Friction {
    /// Coefficient at a sliding speed in m/s, dimensionless.
    ///
    /// ```
    /// use dashpot_rail::creep::Friction;
    /// let falling = Friction { static_coefficient: 0.36, residual_ratio: 0.4, decay_speed_m_per_s: 2.0 };
    /// assert_eq!(falling.at(0.0), 0.36);
    /// assert!((falling.at(100.0) - 0.144).abs() < 1e-12);
    /// ```
    #[inline]
    pub fn at(&self, sliding_speed_m_per_s: f64) -> f64 {
        if self.residual_ratio >= 1.0 {
            self.static_coefficient
        } else {
            self.static_coefficient
                * ((1.0 - self.residual_ratio)
                    * (-sliding_speed_m_per_s / self.decay_speed_m_per_s).exp()
                    + self.residual_ratio)
        }
    }
}
