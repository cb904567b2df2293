//! The discs of a valve as a single plate.

use dashpot_core::parameters::Valve;
use dashpot_core::shim::{Disc, Pack};
use serde::Serialize;

use super::PlateError;

/// Connection between the discs of a stack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stacking {
    /// The discs slide on each other without friction, so their stiffnesses add up: `h_e^3 = sum h_i^3`.
    #[default]
    Sliding,
    /// The discs are bonded, so their thicknesses add up.
    Bonded,
}

/// A stack of discs clamped at one radius and free at another.
#[derive(Clone, Debug)]
pub struct Stack {
    pub(super) disc: Disc,
    discs_m: Vec<f64>,
    stacking: Stacking,
    pub(super) elastic_modulus_pa: f64,
    pub(super) poisson_ratio: f64,
}

impl Stack {
    /// Builds the stack of a valve's shims; `section` names the valve in error messages.
    ///
    /// # Errors
    /// Same errors as [`Pack::new`], for an invalid disc or no shim.
    pub fn new(
        section: &'static str,
        valve: &Valve,
        stacking: Stacking,
    ) -> Result<Self, PlateError> {
        let pack = Pack::new(section, valve)?;
        Ok(Self {
            disc: *pack.disc(),
            discs_m: valve.shims_m.to_vec(),
            stacking,
            elastic_modulus_pa: valve.elastic_modulus_pa,
            poisson_ratio: valve.poisson_ratio,
        })
    }

    /// Returns the clamping radius (m).
    pub fn clamp_radius_m(&self) -> f64 {
        self.disc.clamp_radius_m()
    }

    /// Returns the free radius (m).
    pub fn free_radius_m(&self) -> f64 {
        self.disc.free_radius_m()
    }

    /// Returns the connection between the discs.
    pub fn stacking(&self) -> Stacking {
        self.stacking
    }

    /// Returns the thickness of a single disc with the same bending stiffness (m).
    pub fn equivalent_thickness_m(&self) -> f64 {
        match self.stacking {
            Stacking::Sliding => self.discs_m.iter().map(|h| h * h * h).sum::<f64>().cbrt(),
            Stacking::Bonded => self.discs_m.iter().sum(),
        }
    }

    /// Returns the bending stiffness `D = E h_e^3/(12 (1 - nu^2))` (N m).
    pub fn bending_stiffness_n_m(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.elastic_modulus_pa * self.equivalent_thickness_m().powi(3) / (12.0 * (1.0 - nu * nu))
    }

    /// Returns the thickness that determines the bending stress (m): that of the thickest disc if the discs slide,
    /// otherwise that of the whole stack.
    pub fn bent_thickness_m(&self) -> f64 {
        match self.stacking {
            Stacking::Sliding => self.discs_m.iter().copied().fold(0.0, f64::max),
            Stacking::Bonded => self.equivalent_thickness_m(),
        }
    }

    /// Returns the thickness (m) with which to compare the deflection w: plate theory applies if w is much smaller.
    ///
    /// The ratio of the tension in the stretched middle planes to the bending is proportional to `w^2 sum h/sum h^3`.
    pub fn stretched_thickness_m(&self) -> f64 {
        let whole: f64 = self.discs_m.iter().sum();
        match self.stacking {
            Stacking::Sliding => (self.equivalent_thickness_m().powi(3) / whole).sqrt(),
            Stacking::Bonded => whole,
        }
    }

    /// Returns the numbers of the discs with the maximum stress, counted from 1 in the order of the file.
    pub fn most_stressed_discs(&self) -> Vec<usize> {
        let thickest = self.bent_thickness_m();
        let numbered = self.discs_m.iter().zip(1..);
        match self.stacking {
            Stacking::Sliding => numbered
                .filter(|(h, _)| **h == thickest)
                .map(|(_, number)| number)
                .collect(),
            Stacking::Bonded => [1, self.discs_m.len()].into(),
        }
    }

    /// Returns the edge lift per uniform pressure from the closed form, `Cw(r_w)/h_e^3` (m/Pa).
    pub fn uniform_edge_lift_m_per_pa(&self) -> f64 {
        self.disc.deflection_coefficient(self.free_radius_m())
            / self.equivalent_thickness_m().powi(3)
    }
}
