//! A frictionless stack of discs and the edge compliance of a valve.

use heapless::Vec;

use super::Disc;
use crate::error::BuildError;
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
        let shims_alone = Valve {
            edge_compliance_m_per_pa: None,
            ..valve.clone()
        };
        shims_alone.check(section)?;
        Ok(Self::of(valve))
    }

    /// The pack of a valve that was checked.
    fn of(valve: &Valve) -> Self {
        Self {
            disc: Disc::of(valve),
            shims_m: valve.shims_m.clone(),
        }
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
/// As [`Pack::new`]; shims are needed only where no compliance is given.
pub fn edge_compliance_m_per_pa(section: &'static str, valve: &Valve) -> Result<f64, BuildError> {
    valve.check(section)?;
    Ok(edge_compliance(valve))
}

/// As [`edge_compliance_m_per_pa`], of a valve that was checked.
pub(crate) fn edge_compliance(valve: &Valve) -> f64 {
    let uniform = valve
        .edge_compliance_m_per_pa
        .unwrap_or_else(|| Pack::of(valve).compliance_m_per_pa(valve.free_radius_m));
    uniform * valve.equivalent_pressure_factor
}
