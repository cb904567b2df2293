//! Friction coefficient and its fall with sliding speed.

/// `mu(w) = mu0 ((1 - rest) exp(-w / speed) + rest)` (Polach, Wear 258, 2005, 992-1000).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Coefficient without sliding, dimensionless.
    pub at_rest: f64,
    /// Share left at infinite sliding speed, 0 to 1; 1 for constant friction.
    pub rest: f64,
    /// Sliding speed over which the falling share drops to 1/e, positive, m/s.
    pub speed: f64,
}

impl Default for Friction {
    /// Dry rail, 0.4, not falling.
    fn default() -> Self {
        Self {
            at_rest: 0.4,
            rest: 1.0,
            speed: 1.0,
        }
    }
}

impl Friction {
    /// Coefficient at a sliding speed in m/s.
    #[inline]
    pub fn at(&self, sliding: f64) -> f64 {
        if self.rest >= 1.0 {
            self.at_rest
        } else {
            self.at_rest * ((1.0 - self.rest) * (-sliding / self.speed).exp() + self.rest)
        }
    }
}
