//! One annular disc under uniform pressure.

use heapless::Vec;
use nalgebra::{Matrix4, Vector4};

use crate::error::BuildError;
use crate::math::elementary::log;
use crate::parameters::Valve;

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
    /// Solves the disc's four boundary conditions; `section` names the disc in errors.
    ///
    /// # Errors
    /// A radius, the modulus or Poisson's ratio out of the range of [`Valve::RANGES`].
    pub fn new(
        section: &'static str,
        clamp_radius_m: f64,
        free_radius_m: f64,
        elastic_modulus_pa: f64,
        poisson_ratio: f64,
    ) -> Result<Self, BuildError> {
        let valve = Valve {
            elastic_modulus_pa,
            poisson_ratio,
            // Any thickness: the coefficients hold for all.
            ..Valve::with_shims(clamp_radius_m, free_radius_m, Vec::from_array([1e-3]), 0.0)
        };
        valve.check(section)?;
        Ok(Self::of(&valve))
    }

    /// The disc of a valve that was checked.
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
        // Rows: w(q) = 0, w'(q) = 0, shear(1) = 0, moment(1) = 0, each for
        // ln q, q^2, q^2 ln q, 1; on the right the load q^4/64.
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

    /// Deflection coefficient `Cw(r)` (m^6/N) of `w = Cw P/h^3`, `r` held within the disc.
    pub fn deflection_coefficient(&self, radius_m: f64) -> f64 {
        let q =
            (radius_m / self.free_radius_m).clamp(self.clamp_radius_m / self.free_radius_m, 1.0);
        let [c1, c2, c3, c4] = self.shape;
        let (square, ln) = (q * q, log(q));
        self.scale * (c1 * ln + c2 * square + c3 * square * ln + c4 + square * square / 64.0)
    }

    /// Largest deflection as `K` of `w(r_w) = K P r_w^4/D` (1) (Roark, case 2l).
    pub fn edge_coefficient(&self) -> f64 {
        self.deflection_coefficient(self.free_radius_m) / self.scale
    }

    /// Radial moment at the clamp as `K` of `|M| = K P r_w^2` (1) (Roark, case 2l).
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
