//! A stack of discs without friction, and the edge compliance of a valve.

use super::Disc;
use crate::error::BuildError;
use crate::parameters::{Shims, Valve};

/// Stack of discs with equal radii that slide on each other without friction: `h_e^3 = sum h_i^3`.
#[derive(Clone, Debug, PartialEq)]
pub struct Pack {
    disc: Disc,
    shims_m: Shims,
}

impl Pack {
    /// Builds the pack of a valve; `section` names the valve in errors.
    ///
    /// # Errors
    /// Invalid disc, no shims, or a thickness outside 0.01 to 10 mm.
    pub fn new(section: &'static str, valve: &Valve) -> Result<Self, BuildError> {
        let with_shims_only = Valve {
            edge_compliance_m_per_pa: None,
            ..valve.clone()
        };
        with_shims_only.check(section)?;
        Ok(Self::of(valve))
    }

    /// Returns the pack of a checked valve.
    fn of(valve: &Valve) -> Self {
        Self {
            disc: Disc::of(valve),
            shims_m: valve.shims_m,
        }
    }

    /// Cube of the equivalent thickness `h_e^3 = sum h_i^3` (m^3).
    pub fn equivalent_thickness_cubed_m3(&self) -> f64 {
        self.shims_m.iter().map(|h| h * h * h).sum()
    }

    /// Equivalent thickness h_e (m).
    pub fn equivalent_thickness_m(&self) -> f64 {
        libm::cbrt(self.equivalent_thickness_cubed_m3())
    }

    /// Deflection per uniform pressure at a radius r (m): `Cw(r)/h_e^3` (m/Pa).
    pub fn compliance_m_per_pa(&self, radius_m: f64) -> f64 {
        self.disc.deflection_coefficient(radius_m) / self.equivalent_thickness_cubed_m3()
    }

    /// Returns the disc that all shims share.
    pub fn disc(&self) -> &Disc {
        &self.disc
    }
}

/// Returns the edge lift per working pressure of a valve (m/Pa): the given or the computed compliance times the
/// equivalent-pressure factor Ce. `section` names the valve in errors.
///
/// # Errors
/// Invalid disc, a thickness outside 0.01 to 10 mm, or neither shims nor an edge compliance.
pub fn edge_compliance_m_per_pa(section: &'static str, valve: &Valve) -> Result<f64, BuildError> {
    valve.check(section)?;
    Ok(edge_compliance(valve))
}

/// Returns the edge lift per working pressure of a checked valve (m/Pa).
pub(crate) fn edge_compliance(valve: &Valve) -> f64 {
    let uniform = valve
        .edge_compliance_m_per_pa
        .unwrap_or_else(|| Pack::of(valve).compliance_m_per_pa(valve.free_radius_m));
    uniform * valve.equivalent_pressure_factor
}
