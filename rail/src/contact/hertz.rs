//! Hertz: the ellipse of a smooth contact from its local curvatures.

use crate::math::elliptic::complete;

/// Elastic constants of wheel and rail, the same steel for both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steel {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's number, 0 to 0.5.
    pub poisson: f64,
}

impl Default for Steel {
    /// 210 GPa, 0.3: rail steel.
    fn default() -> Self {
        Self {
            young: 210e9,
            poisson: 0.3,
        }
    }
}

impl Steel {
    /// Shear modulus `E / (2 (1 + nu))`, Pa.
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Plane modulus of the two bodies together, `E / (2 (1 - nu^2))`, Pa.
    fn plane(&self) -> f64 {
        self.young / (2.0 * (1.0 - self.poisson * self.poisson))
    }
}

/// What a contact's curvatures fix: `load = stiffness penetration^1.5`, `semi-axis = factor sqrt(penetration)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// Load over penetration to 1.5, N/m^1.5.
    pub stiffness: f64,
    /// Semi-axis in the rolling direction over the root of the penetration, m^0.5.
    pub rolling: f64,
    /// Semi-axis across over the root of the penetration, m^0.5.
    pub across: f64,
}

impl Hertz {
    /// The contact of relative curvatures `1/R` in the rolling direction and across, 1/m, both positive.
    ///
    /// With `A + B` half their sum and `k` the least over the greatest semi-axis `a`:
    /// `a^3 = 3 N E(k) / (2 pi k^2 E* (A + B))`, penetration `3 N K(k) / (2 pi a E*)`,
    /// `B / A = (E / k^2 - K) / (K - E)` (Johnson, Contact Mechanics, 1985, 4.26).
    pub fn new(steel: &Steel, rolling: f64, across: f64) -> Self {
        let half_sum = 0.5 * (rolling + across);
        let k = axis_ratio(rolling.max(across) / rolling.min(across));
        let (first, second) = complete(k);
        let pi = std::f64::consts::PI;
        // a = long load^(1/3), penetration = depth load^(2/3).
        let plane = steel.plane();
        let long = (3.0 * second / (2.0 * pi * k * k * plane * half_sum)).cbrt();
        let depth = 3.0 * first / (2.0 * pi * long * plane);
        let stiffness = depth.powf(-1.5);
        let greatest = long * stiffness.cbrt();
        let (along, aside) = if rolling > across {
            (k * greatest, greatest)
        } else {
            (greatest, k * greatest)
        };
        Self {
            stiffness,
            rolling: along,
            across: aside,
        }
    }

    /// Load of a penetration, N; none when the bodies are apart.
    pub fn load(&self, penetration: f64) -> f64 {
        let p = penetration.max(0.0);
        self.stiffness * p * p.sqrt()
    }

    /// Penetration under a load, m.
    pub fn penetration(&self, load: f64) -> f64 {
        (load.max(0.0) / self.stiffness).powf(2.0 / 3.0)
    }

    /// Semi-axes (rolling direction, across) at a penetration, m.
    pub fn semi_axes(&self, penetration: f64) -> (f64, f64) {
        let root = penetration.max(0.0).sqrt();
        (self.rolling * root, self.across * root)
    }
}

/// Least over greatest semi-axis of a contact whose curvatures stand as `ratio` >= 1, by bisection.
fn axis_ratio(ratio: f64) -> f64 {
    if ratio < 1.0 + 1e-9 {
        return 1.0;
    }
    let curvatures = |k: f64| {
        let (first, second) = complete(k);
        (second / (k * k) - first) / (first - second)
    };
    let (mut low, mut high) = (1e-5_f64, 1.0 - 1e-7);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if curvatures(middle) > ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low * high).sqrt()
}
