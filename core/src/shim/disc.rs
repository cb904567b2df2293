//! An annular disc under uniform pressure.

use nalgebra::{Matrix4, Vector4};

use crate::error::BuildError;
use crate::math::elementary::log;
use crate::parameters::{Shims, Valve};

/// Annular disc of a pack: clamped at `clamp_radius_m`, free at `free_radius_m`.
///
/// Deflection under uniform pressure P with thickness h:
/// `w(r) = C1 ln r + C2 r^2 + C3 r^2 ln r + C4 + P r^4/(64 D) = Cw(r) P/h^3`,
/// `D = E h^3/(12 (1 - nu^2))`, with `w = w' = 0` at the clamp and no shear and no moment at the
/// free edge (Timoshenko, Theory of Plates and Shells; Eqs. 3-22 of the source paper).
///
/// ```
/// use dashpot_core::shim::Disc;
/// let disc = Disc::new("disc", 16e-3, 29e-3, 2.0e11, 0.3)?;
/// assert!((disc.deflection_coefficient(29e-3) - 2.1427e-19).abs() < 1e-23);
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    clamp_radius_m: f64,
    free_radius_m: f64,
    /// Coefficients of ln q, q^2, q^2 ln q and 1, with q = r/r_w, per P r_w^4/D.
    shape: [f64; 4],
    /// r_w^4 h^3/D (m^6/N).
    scale: f64,
    poisson_ratio: f64,
}

impl Disc {
    /// Solves the four boundary conditions of a disc: radii (m), elastic modulus (Pa), Poisson's ratio (1).
    ///
    /// `section` names the disc in errors.
    ///
    /// # Errors
    /// A radius, the modulus or Poisson's ratio is outside the range of [`Valve::RANGES`].
    pub fn new(
        section: &'static str,
        clamp_radius_m: f64,
        free_radius_m: f64,
        elastic_modulus_pa: f64,
        poisson_ratio: f64,
    ) -> Result<Self, BuildError> {
        // The coefficients do not depend on the thickness.
        const ANY: Shims = Shims::new(&[1e-3]).unwrap();
        let valve = Valve::with_shims(clamp_radius_m, free_radius_m, ANY, 0.0)
            .elastic_modulus_pa(elastic_modulus_pa)
            .poisson_ratio(poisson_ratio);
        valve.check(section)?;
        Ok(Self::of(&valve))
    }

    /// Returns the disc of a checked valve.
    pub(crate) fn of(valve: &Valve) -> Self {
        let &Valve {
            clamp_radius_m,
            free_radius_m,
            elastic_modulus_pa,
            poisson_ratio,
            ..
        } = valve;
        let q = clamp_radius_m / free_radius_m;
        let (nu, ln) = (poisson_ratio, log(q));
        // Rows: w(q) = 0, w'(q) = 0, shear(1) = 0, moment(1) = 0. Columns: ln q, q^2, q^2 ln q, 1. The right-hand side
        // is the load q^4/64.
        #[rustfmt::skip]
        let conditions = Matrix4::new(
            ln,       q * q,           q * q * ln,          1.0,
            1.0 / q,  2.0 * q,         2.0 * q * ln + q,    0.0,
            0.0,      0.0,             4.0,                 0.0,
            nu - 1.0, 2.0 * (1.0 + nu), 3.0 + nu,           0.0,
        );
        let load = Vector4::new(
            -q * q * q * q / 64.0,
            -q * q * q / 16.0,
            -0.5,
            -(3.0 + nu) / 16.0,
        );
        let shape = conditions
            .lu()
            .solve(&load)
            .map_or([0.0; 4], |solution| solution.into());
        let square = free_radius_m * free_radius_m;
        Self {
            clamp_radius_m,
            free_radius_m,
            shape,
            scale: square * square * 12.0 * (1.0 - nu * nu) / elastic_modulus_pa,
            poisson_ratio,
        }
    }

    /// Deflection coefficient `Cw(r)` (m^6/N) of `w = Cw P/h^3`; the radius (m) is limited to the disc.
    pub fn deflection_coefficient(&self, radius_m: f64) -> f64 {
        let q =
            (radius_m / self.free_radius_m).clamp(self.clamp_radius_m / self.free_radius_m, 1.0);
        let [c1, c2, c3, c4] = self.shape;
        let (square, ln) = (q * q, log(q));
        self.scale * (c1 * ln + c2 * square + c3 * square * ln + c4 + square * square / 64.0)
    }

    /// Coefficient `K` of the largest deflection `w(r_w) = K P r_w^4/D` (1) (Roark, case 2l).
    pub fn edge_coefficient(&self) -> f64 {
        self.deflection_coefficient(self.free_radius_m) / self.scale
    }

    /// Coefficient `K` of the radial moment at the clamp `|M| = K P r_w^2` (1) (Roark, case 2l).
    pub fn clamp_moment_coefficient(&self) -> f64 {
        let q = self.clamp_radius_m / self.free_radius_m;
        let nu = self.poisson_ratio;
        let [c1, c2, c3, _] = self.shape;
        let curvature = c1 * (nu - 1.0) / (q * q)
            + 2.0 * c2 * (1.0 + nu)
            + c3 * (2.0 * (1.0 + nu) * log(q) + 3.0 + nu)
            + q * q * (3.0 + nu) / 16.0;
        curvature.abs()
    }

    /// Clamping radius r_n (m).
    pub fn clamp_radius_m(&self) -> f64 {
        self.clamp_radius_m
    }

    /// Free radius r_w (m).
    pub fn free_radius_m(&self) -> f64 {
        self.free_radius_m
    }
}
