//! Exact theory of rolling contact: the tractions that two equal elastic half-spaces exert on each other in
//! steady rolling, under Hertz pressure and Coulomb friction (Kalker, Three-Dimensional Elastic Bodies in Rolling
//! Contact, 1990).
//!
//! The slip of the wheel's surface on the rail, divided by the speed, is `s = w - du/dx`, where
//! `w = (xi - phi y, eta + phi x)` is the rigid slip and `u` the elastic displacement of the wheel's surface relative
//! to the rail's. Without slip the traction is within the friction limit; with slip it has the magnitude of friction
//! and opposes `s`. Axes and signs are those of [`dashpot_rail::creep`].
//!
//! It shares no law with the code that it checks: neither Kalker's coefficients nor a simplified elasticity.

mod influence;
mod mesh;
mod sliding;
mod traction;

use dashpot_rail::creep::{CreepForces, Creepage, LoadedContact};
use influence::slip_by_strip;
use mesh::Element;
pub use sliding::full_sliding;
use traction::traction;

use crate::error::ReferenceError;

/// Creepages divided by `mu N / (G a b)`: longitudinal, lateral, and spin times `sqrt(a b)`.
pub type ScaledCreepage = [f64; 3];

/// Longitudinal and lateral force divided by `mu N`, and spin moment divided by `mu N sqrt(a b)`.
pub type ScaledForces = [f64; 3];

/// The iteration has converged if a sweep changes all tractions together by less than this fraction of `mu N`.
pub const TOLERANCE: f64 = 1e-5;

/// Relaxation factor of a sweep. The slip depends on the tractions ahead and behind through a kernel without definite
/// sign, so full steps diverge.
const RELAXATION: f64 = 0.3;

/// Maximum number of sweeps; the solution usually takes 30 to 200.
const MAX_SWEEPS: usize = 1000;

/// Rolling contacts with one ratio of semi-axes and one Poisson's ratio, on one mesh.
///
/// ```
/// use dashpot_reference::rolling_contact::RollingContact;
/// let circle = RollingContact::new(1.0, 0.25)?;
/// let creepage = 1e-3;
/// // Kalker's C11 of 1967 is 4.12.
/// let [force, _, _] = circle.solve([creepage, 0.0, 0.0])?;
/// assert!((-force / creepage / 4.12 - 1.0).abs() < 0.01);
/// # Ok::<(), dashpot_reference::ReferenceError>(())
/// ```
pub struct RollingContact {
    elements: Vec<Element>,
    /// Influence coefficients, slip at one element per traction at another: longitudinal slip per longitudinal
    /// traction, lateral per lateral, longitudinal per lateral.
    slip: [Vec<f64>; 3],
}

impl RollingContact {
    /// Builds contacts with the semi-axes `a` in the rolling direction and `b` across, on a mesh whose forces are
    /// accurate to about half a percent of `mu N`.
    ///
    /// # Errors
    /// The ratio is not positive, or Poisson's ratio is not within 0 to 0.5.
    pub fn new(a_over_b: f64, poisson_ratio: f64) -> Result<Self, ReferenceError> {
        let [along, strips] = Self::usual_mesh(a_over_b);
        Self::with_mesh(a_over_b, poisson_ratio, along, strips)
    }

    /// Number of elements per strip, and number of strips, that [`Self::new`] uses.
    ///
    /// A strip must not be much wider than the contact is long; otherwise the pole of spin jumps from strip to strip.
    /// In a long contact, each element is longer than its strip is wide.
    pub fn usual_mesh(a_over_b: f64) -> [usize; 2] {
        let min_strips = 12.0 * (0.5 * a_over_b).max(1.0).powf(0.22);
        let strips = (10.0 / a_over_b).clamp(min_strips, 40.0).ceil();
        let along = (24.0 * a_over_b.powf(0.22))
            .max(400.0 / strips)
            .max(20.0)
            .ceil();
        [along as usize, strips as usize]
    }

    /// Builds contacts as [`Self::new`] does, with `strips` strips of `along` elements.
    ///
    /// # Errors
    /// The errors of [`Self::new`], or a mesh without elements.
    pub fn with_mesh(
        a_over_b: f64,
        poisson_ratio: f64,
        along: usize,
        strips: usize,
    ) -> Result<Self, ReferenceError> {
        let possible = a_over_b > 0.0 && a_over_b.is_finite() && along > 0 && strips > 0;
        if !(possible && (0.0..=0.5).contains(&poisson_ratio)) {
            return Err(ReferenceError::RollingContact {
                a_over_b,
                poisson_ratio,
                along,
                strips,
            });
        }
        let elements = mesh::elements(a_over_b, along, strips);
        let mut slip = [const { Vec::new() }; 3];
        for to in elements.chunks(along) {
            let blocks: Vec<_> = elements
                .chunks(along)
                .map(|from| slip_by_strip(to, from, poisson_ratio))
                .collect();
            for row in 0..along {
                let row_slips = blocks
                    .iter()
                    .flat_map(|block| &block[row * along..(row + 1) * along]);
                for by_element in row_slips {
                    for (slip, by_element) in slip.iter_mut().zip(by_element) {
                        slip.push(*by_element);
                    }
                }
            }
        }
        Ok(Self { elements, slip })
    }

    /// Returns the forces at a creepage.
    ///
    /// # Errors
    /// The tractions do not converge.
    pub fn solve(&self, creepage: ScaledCreepage) -> Result<ScaledForces, ReferenceError> {
        self.solve_from(creepage, &mut Tractions::default())
    }

    /// Solves as [`Self::solve`] does, starting from `tractions` (zero if empty) and replacing them by the solution.
    ///
    /// # Errors
    /// The errors of [`Self::solve`].
    pub fn solve_from(
        &self,
        creepage: ScaledCreepage,
        tractions: &mut Tractions,
    ) -> Result<ScaledForces, ReferenceError> {
        let count = self.elements.len();
        tractions.along.resize(count, 0.0);
        tractions.across.resize(count, 0.0);
        for _ in 0..MAX_SWEEPS {
            let change = self.sweep(creepage, tractions);
            if change < TOLERANCE {
                return Ok(self.forces(tractions));
            }
            if !change.is_finite() {
                break;
            }
        }
        Err(ReferenceError::RollingDiverges { creepage })
    }

    /// Forces on a contact in SI units. The ratio of its semi-axes and its Poisson's ratio must be equal to those of
    /// `self`; its Kalker coefficients are not used.
    ///
    /// # Errors
    /// The errors of [`Self::solve`].
    pub fn creep_forces(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> Result<CreepForces, ReferenceError> {
        let limit = contact.friction * contact.load_n;
        let area = contact.a_m * contact.b_m;
        let scale = contact.shear_modulus_pa * area / limit;
        let scaled = [
            scale * creepage.longitudinal,
            scale * creepage.lateral,
            scale * area.sqrt() * creepage.spin_per_m,
        ];
        let [x, y, m] = self.solve(scaled)?;
        Ok(CreepForces {
            longitudinal_n: limit * x,
            lateral_n: limit * y,
            moment_n_m: limit * area.sqrt() * m,
        })
    }

    /// Runs one Gauss-Seidel sweep from the leading to the trailing edge of each strip; returns the sum of the changes.
    fn sweep(&self, [xi, eta, phi]: ScaledCreepage, tractions: &mut Tractions) -> f64 {
        let count = self.elements.len();
        let mut change = 0.0;
        for (index, element) in self.elements.iter().enumerate() {
            let row = index * count..(index + 1) * count;
            let [xx, yy, xy] = [0, 1, 2].map(|k| &self.slip[k][row.clone()]);
            let own = [xx[index], yy[index]];
            let elastic = slip_of(xx, yy, xy, tractions);
            let old = [tractions.along[index], tractions.across[index]];
            let others = [
                xi - phi * element.y + elastic[0] - own[0] * old[0],
                eta + phi * element.slip_x + elastic[1] - own[1] * old[1],
            ];
            // Sliding is evaluated where the traction acts.
            let shift = [0.0, phi * (element.x - element.slip_x)];
            let solved = traction(others, own, shift, element.pressure);
            let step = [0, 1].map(|k| RELAXATION * (solved[k] - old[k]));
            tractions.along[index] += step[0];
            tractions.across[index] += step[1];
            change += (step[0].abs() + step[1].abs()) * element.area;
        }
        change
    }

    fn forces(&self, tractions: &Tractions) -> ScaledForces {
        let mut sum = [0.0; 3];
        let both = tractions.along.iter().zip(&tractions.across);
        for (element, (px, py)) in self.elements.iter().zip(both) {
            sum[0] += px * element.area;
            sum[1] += py * element.area;
            sum[2] += (element.x * py - element.y * px) * element.area;
        }
        sum
    }

    /// Largest traction relative to the friction limit of its element; 1 if any element slides.
    pub fn max_utilisation(&self, tractions: &Tractions) -> f64 {
        let both = tractions.along.iter().zip(&tractions.across);
        let used = both.map(|(px, py)| px.hypot(*py));
        used.zip(&self.elements)
            .map(|(used, element)| used / element.pressure)
            .fold(0.0, f64::max)
    }
}

/// Tractions of every element, divided by `mu N / (a b)`.
#[derive(Debug, Clone, Default)]
pub struct Tractions {
    along: Vec<f64>,
    across: Vec<f64>,
}

/// Longitudinal and lateral slip that all tractions cause.
#[inline]
fn slip_of(xx: &[f64], yy: &[f64], xy: &[f64], tractions: &Tractions) -> [f64; 2] {
    // With several partial sums, the compiler uses vector instructions.
    const LANES: usize = 4;
    let mut sums = [[0.0; LANES]; 2];
    let mut add = |from: usize, lanes: usize| {
        for (lane, at) in (from..from + lanes).enumerate() {
            let (px, py) = (tractions.along[at], tractions.across[at]);
            sums[0][lane] += xx[at] * px + xy[at] * py;
            sums[1][lane] += xy[at] * px + yy[at] * py;
        }
    };
    let whole = xx.len() / LANES * LANES;
    for from in (0..whole).step_by(LANES) {
        add(from, LANES);
    }
    add(whole, xx.len() - whole);
    sums.map(|lanes| lanes.iter().sum())
}
