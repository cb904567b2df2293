//! A frictionless stack of discs and the edge compliance of a valve.

use heapless::Vec;

use super::Disc;
use crate::error::{BuildError, require};
use crate::parameters::{MAX_SHIMS, Valve};

/// Stack of discs with equal radii that slide on each other: `h_e^3 = sum h_i^3`.
#[derive(Clone, Debug, PartialEq)]
pub struct Pack {
    disc: Disc,
    shims_m: Vec<f64, MAX_SHIMS>,
}

impl Pack {
    /// The pack of a valve; `section` names the valve in errors.
    ///
    /// # Errors
    /// A disc that cannot be, no shim, or a thickness outside 0.01 to 10 mm.
    pub fn new(section: &'static str, valve: &Valve) -> Result<Self, BuildError> {
        require(
            section,
            "shims_m",
            valve.shims_m.len() as f64,
            !valve.shims_m.is_empty(),
            "1 to 16 shims when edge_compliance_m_per_pa is not given",
        )?;
        for &thickness in &valve.shims_m {
            require(
                section,
                "shims_m",
                thickness,
                (1e-5..=1e-2).contains(&thickness),
                "1e-5 to 1e-2 m each",
            )?;
        }
        Ok(Self {
            disc: Disc::new(
                section,
                valve.clamp_radius_m,
                valve.free_radius_m,
                valve.elastic_modulus_pa,
                valve.poisson_ratio,
            )?,
            shims_m: valve.shims_m.clone(),
        })
    }

    /// Equivalent thickness cubed `h_e^3 = sum h_i^3` (m^3).
    pub fn equivalent_thickness_cubed_m3(&self) -> f64 {
        self.shims_m.iter().map(|h| h * h * h).sum()
    }

    /// Equivalent thickness h_e (m).
    pub fn equivalent_thickness_m(&self) -> f64 {
        libm::cbrt(self.equivalent_thickness_cubed_m3())
    }

    /// Deflection per uniform pressure at radius r, `Cw(r)/h_e^3` (m/Pa).
    pub fn compliance_m_per_pa(&self, radius_m: f64) -> f64 {
        self.disc.deflection_coefficient(radius_m) / self.equivalent_thickness_cubed_m3()
    }

    /// The disc all shims share.
    pub fn disc(&self) -> &Disc {
        &self.disc
    }
}

/// Edge lift per working pressure of a valve (m/Pa): the given or the computed compliance times
/// the equivalent-pressure factor Ce.
///
/// # Errors
/// As [`Pack::new`], or a given compliance that is negative.
pub fn edge_compliance_m_per_pa(section: &'static str, valve: &Valve) -> Result<f64, BuildError> {
    let uniform = match valve.edge_compliance_m_per_pa {
        Some(given) => {
            require(
                section,
                "edge_compliance_m_per_pa",
                given,
                (0.0..=1e-6).contains(&given),
                "0 to 1e-6 m/Pa",
            )?;
            given
        }
        None => Pack::new(section, valve)?.compliance_m_per_pa(valve.free_radius_m),
    };
    Ok(uniform * valve.equivalent_pressure_factor)
}
