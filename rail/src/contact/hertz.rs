//! Hertzian contact: stiffness and contact ellipse of two smooth elastic bodies.

use crate::math::elliptic::complete;
use crate::setters::setters;

/// Elastic constants, the same for wheel and rail.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Steel {
    /// Young's modulus, Pa.
    pub young_modulus_pa: f64,
    /// Poisson's ratio, 0 to 0.5.
    pub poisson_ratio: f64,
}

impl Default for Steel {
    /// Rail steel: 210 GPa, 0.3.
    fn default() -> Self {
        Self {
            young_modulus_pa: 210e9,
            poisson_ratio: 0.3,
        }
    }
}

/// Errors in elastic constants.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SteelError {
    /// Young's modulus is out of bounds.
    #[error("Young's modulus: {young_modulus_pa} Pa, allowed: 1e9 to 1e12 Pa")]
    YoungModulus {
        /// Young's modulus, Pa.
        young_modulus_pa: f64,
    },
    /// Poisson's ratio is out of bounds.
    #[error("Poisson's ratio: {poisson_ratio}, allowed: 0 to 0.5")]
    PoissonRatio {
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
}

impl Steel {
    setters! {
        with_young_modulus_pa sets young_modulus_pa: f64;
        with_poisson_ratio sets poisson_ratio: f64;
    }

    /// Checks that both constants are within their bounds.
    ///
    /// # Errors
    /// Young's modulus is not within 1e9 to 1e12 Pa, or Poisson's ratio is not within 0 to 0.5.
    pub fn check(&self) -> Result<(), SteelError> {
        let Self {
            young_modulus_pa,
            poisson_ratio,
        } = *self;
        if !(1e9..=1e12).contains(&young_modulus_pa) {
            return Err(SteelError::YoungModulus { young_modulus_pa });
        }
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return Err(SteelError::PoissonRatio { poisson_ratio });
        }
        Ok(())
    }

    /// Shear modulus `E / (2 (1 + nu))`, Pa.
    ///
    /// ```
    /// let steel = dashpot_rail::contact::Steel::default();
    /// assert!((steel.shear_modulus_pa() / 80.77e9 - 1.0).abs() < 1e-4);
    /// ```
    pub fn shear_modulus_pa(&self) -> f64 {
        self.young_modulus_pa / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Contact modulus of the pair of bodies, `E* = E / (2 (1 - nu^2))`, Pa.
    pub(super) fn contact_modulus_pa(&self) -> f64 {
        self.young_modulus_pa / (2.0 * (1.0 - self.poisson_ratio * self.poisson_ratio))
    }
}

/// A Hertzian contact: `load = stiffness * penetration^1.5`, `semi-axis = factor * sqrt(penetration)`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hertz {
    /// Load divided by `penetration^1.5`, N/m^1.5.
    pub stiffness_n_per_m_1_5: f64,
    /// Semi-axis `a`, in the rolling direction, divided by the square root of the penetration, m^0.5.
    pub a_factor_m_0_5: f64,
    /// Semi-axis `b`, across, divided by the square root of the penetration, m^0.5.
    pub b_factor_m_0_5: f64,
}

impl Hertz {
    /// Contact of two bodies with the given relative curvatures `1/R` in the rolling direction and across, 1/m.
    ///
    /// `A + B` is half the sum of the curvatures, `a` the major semi-axis, and `k` the minor divided by the major one:
    /// `a^3 = 3 N E(k) / (2 pi k^2 E* (A + B))`, penetration `3 N K(k) / (2 pi a E*)`,
    /// `B / A = (E / k^2 - K) / (K - E)` (Johnson, Contact Mechanics, 1985, 4.26).
    /// Unless both curvatures are positive, there is no Hertzian contact: stiffness and semi-axes are zero.
    ///
    /// ```
    /// use dashpot_rail::contact::{Hertz, Steel};
    /// // A wheel of 0.625 m radius on a rail head of R 300, 101.34 kN.
    /// let hertz = Hertz::new(&Steel::default(), 1.0 / 0.625, 1.0 / 0.300);
    /// let [a_m, b_m] = hertz.semi_axes_m(hertz.penetration_m(101_340.0));
    /// assert!((a_m - 8.340e-3).abs() < 1e-6 && (b_m - 5.119e-3).abs() < 1e-6);
    /// ```
    pub fn new(steel: &Steel, rolling_per_m: f64, across_per_m: f64) -> Self {
        let (rolling, across) = (rolling_per_m, across_per_m);
        if !(rolling > 0.0 && across > 0.0 && rolling.is_finite() && across.is_finite()) {
            return Self {
                stiffness_n_per_m_1_5: 0.0,
                a_factor_m_0_5: 0.0,
                b_factor_m_0_5: 0.0,
            };
        }
        let half_sum = 0.5 * (rolling + across);
        let k = axis_ratio(rolling.max(across) / rolling.min(across));
        let (first, second) = complete(k);
        let pi = std::f64::consts::PI;
        // The major semi-axis is `major * load^(1/3)`, the penetration `depth * load^(2/3)`.
        let modulus = steel.contact_modulus_pa();
        let major = libm::cbrt(3.0 * second / (2.0 * pi * k * k * modulus * half_sum));
        let depth = 3.0 * first / (2.0 * pi * major * modulus);
        let stiffness = libm::pow(depth, -1.5);
        let major_factor = major * libm::cbrt(stiffness);
        let (a, b) = if rolling > across {
            (k * major_factor, major_factor)
        } else {
            (major_factor, k * major_factor)
        };
        Self {
            stiffness_n_per_m_1_5: stiffness,
            a_factor_m_0_5: a,
            b_factor_m_0_5: b,
        }
    }

    /// Normal load at a penetration, N; zero if the bodies are apart.
    pub fn load_n(&self, penetration_m: f64) -> f64 {
        let p = penetration_m.max(0.0);
        self.stiffness_n_per_m_1_5 * p * p.sqrt()
    }

    /// Penetration under a normal load, m.
    pub fn penetration_m(&self, load_n: f64) -> f64 {
        libm::pow(load_n.max(0.0) / self.stiffness_n_per_m_1_5, 2.0 / 3.0)
    }

    /// Semi-axes `[a, b]` (rolling direction, across) at a penetration, m; zero if the bodies are apart.
    pub fn semi_axes_m(&self, penetration_m: f64) -> [f64; 2] {
        let root = penetration_m.max(0.0).sqrt();
        [self.a_factor_m_0_5 * root, self.b_factor_m_0_5 * root]
    }
}

/// Minor divided by major semi-axis, computed from the ratio of the curvatures, which is at least 1. The secant method
/// on logarithms starts from the power law of Hamrock and Brewe (1983).
fn axis_ratio(ratio: f64) -> f64 {
    if ratio < 1.0 + 1e-9 {
        return 1.0;
    }
    let residual = |logarithm: f64| {
        let k = libm::exp(logarithm);
        let (first, second) = complete(k);
        libm::log((second / (k * k) - first) / (first - second) / ratio)
    };
    let mut before = -0.636 * libm::log(ratio);
    let mut logarithm = 0.99 * before;
    let mut residual_before = residual(before);
    for _ in 0..20 {
        let here = residual(logarithm);
        let step = here * (logarithm - before) / (here - residual_before);
        if !step.is_finite() {
            break;
        }
        (before, residual_before) = (logarithm, here);
        logarithm = (logarithm - step).min(0.0);
        if step.abs() < 1e-14 {
            break;
        }
    }
    libm::exp(logarithm)
}
