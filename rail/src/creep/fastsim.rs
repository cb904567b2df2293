//! FASTSIM, Kalker's simplified theory.

use std::f64::consts::PI;

use super::creepage::Creepage;
use super::forces::CreepForces;
use super::law::CreepLaw;
use super::loaded_contact::LoadedContact;
use crate::setters::setters;

/// Kalker's FASTSIM (Vehicle System Dynamics 11, 1982, 1-13).
///
/// The three flexibilities are `L1 = 8a/(3 C11 G)`, `L2 = 8a/(3 C22 G)` and `L3 = pi a sqrt(a/b)/(4 C23 G)`; the
/// traction bound is the parabola `2 mu N / (pi a b) (1 - x^2/a^2 - y^2/b^2)`. The tractions are integrated by the
/// midpoint rule across and along the strips.
///
/// The traction of a sliding element opposes the slip, including its elastic part, although `L1 != L2`. The source
/// instead scales the sticking traction back to the bound, which would rotate the force of full sliding towards
/// `(C11 xi, C22 eta)`. With zero elements or strips there is no force.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Fastsim {
    /// Number of elements along each strip.
    pub elements: u32,
    /// Number of strips.
    pub strips: u32,
}

impl Default for Fastsim {
    /// 80 elements x 81 strips. A mesh four times finer in both directions changes the result by at most 0.3 % of the
    /// friction limit.
    fn default() -> Self {
        Self {
            elements: 80,
            strips: 81,
        }
    }
}

impl Fastsim {
    setters! {
        with_elements sets elements: u32;
        with_strips sets strips: u32;
    }
}

impl CreepLaw for Fastsim {
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let &LoadedContact {
            load_n: load,
            a_m: a,
            b_m: b,
            shear_modulus_pa: shear,
            kalker,
            friction,
        } = contact;
        let l1 = 8.0 * a / (3.0 * kalker.c11 * shear);
        let l2 = 8.0 * a / (3.0 * kalker.c22 * shear);
        let l3 = PI * a * (a / b).sqrt() / (4.0 * kalker.c23 * shear);
        let (rigid_x, rigid_y) = (creepage.longitudinal / l1, creepage.lateral / l2);
        let spin = creepage.spin_per_m / l3;
        let peak = 2.0 * friction * load / (PI * a * b);
        let width = 2.0 * b / f64::from(self.strips);
        let mut sum = CreepForces::default();
        for strip in 0..self.strips {
            let y = -b + (f64::from(strip) + 0.5) * width;
            let half = a * (1.0 - (y / b).powi(2)).max(0.0).sqrt();
            let dx = 2.0 * half / f64::from(self.elements);
            // The traction is zero at the leading edge, half a step before the midpoint of the first element.
            let (mut px, mut py, mut step) = (0.0, 0.0, 0.5 * dx);
            for element in 0..self.elements {
                let x = half - (f64::from(element) + 0.5) * dx;
                // The rigid slip is linear in x, so this integral from the previous midpoint is exact.
                let middle = x + 0.5 * step;
                px -= step * (rigid_x - spin * y);
                py -= step * (rigid_y + spin * middle);
                let bound = peak * (half * half - x * x) / (a * a);
                [px, py] = within_friction([px, py], [l1, l2], bound);
                let area = dx * width;
                sum.longitudinal_n += px * area;
                sum.lateral_n += py * area;
                sum.moment_n_m += (x * py - y * px) * area;
                step = dx;
            }
        }
        sum
    }
}

/// Traction `p` of an element: the `sticking` traction if its magnitude is within `bound`; otherwise a traction of
/// magnitude `bound` that opposes the slip `L (p - sticking)`, with the flexibilities `L`.
fn within_friction(sticking: [f64; 2], flexibilities: [f64; 2], bound: f64) -> [f64; 2] {
    let [x, y] = sticking;
    if x * x + y * y <= bound * bound {
        return sticking;
    }
    // (L + r) p = L sticking with the resistance r = |slip| / bound. 1/|p| is nearly linear in r, so three Newton steps
    // suffice for flexibilities that differ by half.
    let mut resistance = 0.0;
    let mut p = sticking;
    for _ in 0..3 {
        let square = p[0] * p[0] + p[1] * p[1];
        let slope: f64 = (0..2)
            .map(|k| p[k] * p[k] / (flexibilities[k] + resistance))
            .sum();
        resistance += square / slope * (square.sqrt() / bound - 1.0);
        p = [0, 1].map(|k| sticking[k] * flexibilities[k] / (flexibilities[k] + resistance));
    }
    let factor = bound / (p[0] * p[0] + p[1] * p[1]).sqrt();
    p.map(|p| p * factor)
}
