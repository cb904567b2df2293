//! Shim-pack valves of a damper, each with its published table.

use dashpot_core::characteristic::ShimPackValve;
use dashpot_core::parameters::{Hydraulics, Valve};
use dashpot_core::shim::Pack;

use super::TestbenchError;
use super::published::{self, Deflection, deflections};

/// One of the shim-pack valves of a damper.
pub struct ValveLocation {
    /// Display name.
    pub name: &'static str,
    /// Section of the damper file.
    pub section: &'static str,
    /// Identifier of the valve in the core's characteristic.
    pub valve: ShimPackValve,
    /// Number of the paper's table of deflections.
    pub table: u8,
    select: fn(&Hydraulics) -> &Valve,
    published: &'static str,
}

/// The three valves.
pub const VALVE_LOCATIONS: [ValveLocation; 3] = [
    ValveLocation {
        name: "piston extension",
        section: "valves.piston_extension",
        valve: ShimPackValve::PistonExtension,
        select: |hydraulics| &hydraulics.valves.piston_extension,
        table: 2,
        published: published::TABLE_2,
    },
    ValveLocation {
        name: "piston compression",
        section: "valves.piston_compression",
        valve: ShimPackValve::PistonCompression,
        select: |hydraulics| &hydraulics.valves.piston_compression,
        table: 3,
        published: published::TABLE_3,
    },
    ValveLocation {
        name: "foot compression",
        section: "valves.foot_compression",
        valve: ShimPackValve::FootCompression,
        select: |hydraulics| &hydraulics.valves.foot_compression,
        table: 4,
        published: published::TABLE_4,
    },
];

impl ValveLocation {
    /// Returns the parameters of this valve.
    pub fn valve_of<'a>(&self, hydraulics: &'a Hydraulics) -> &'a Valve {
        (self.select)(hydraulics)
    }

    /// Returns the shim pack of this valve; `None` if the damper file describes none.
    ///
    /// # Errors
    /// Returns an error if disc theory does not apply to the pack.
    pub fn pack(&self, hydraulics: &Hydraulics) -> Result<Option<Pack>, TestbenchError> {
        let valve = self.valve_of(hydraulics);
        if valve.shims_m.is_empty() {
            return Ok(None);
        }
        Ok(Some(Pack::new(self.section, valve)?))
    }

    /// Returns the edge compliance of the pack by disc theory under uniform pressure (m/Pa).
    ///
    /// # Errors
    /// Same errors as [`ValveLocation::pack`].
    pub fn theory_m_per_pa(&self, hydraulics: &Hydraulics) -> Result<Option<f64>, TestbenchError> {
        let edge = self.valve_of(hydraulics).free_radius_m;
        let pack = self.pack(hydraulics)?;
        Ok(pack.map(|pack| pack.compliance_m_per_pa(edge)))
    }

    /// Returns the rows of the published table.
    ///
    /// # Errors
    /// Returns an error if the built-in table is corrupt.
    pub fn published(&self) -> Result<Vec<Deflection>, TestbenchError> {
        deflections(self.published)
    }
}

/// Returns the edge deflection by disc theory divided by the published one, under uniform pressure at the table's
/// highest pressure.
pub fn theory_over_published(theory_m_per_pa: f64, published: &[Deflection]) -> Option<f64> {
    let row = published.last()?;
    Some(theory_m_per_pa * row.pressure_pa() / row.theory_uniform_m())
}

/// Describes the first erratum of the source paper, computed from the paper's damper.
///
/// # Errors
/// Same errors as [`ValveLocation::pack`] and [`ValveLocation::published`].
pub fn erratum(paper: &Hydraulics) -> Result<String, TestbenchError> {
    let ratio = |location: &ValveLocation| -> Result<String, TestbenchError> {
        let theory = location.theory_m_per_pa(paper)?;
        let published = location.published()?;
        let ratio = theory.and_then(|theory| theory_over_published(theory, &published));
        Ok(ratio.map_or_else(|| "-".into(), |ratio| format!("{ratio:.0}")))
    };
    let [extension, compression, foot] = &VALVE_LOCATIONS;
    Ok(format!(
        "Tables 2-4 of the paper do not follow from its Table 1: the disc theory gives {}, {} and {} \
         times the tabulated deflections, and no bonded stack fits either.",
        ratio(extension)?,
        ratio(compression)?,
        ratio(foot)?
    ))
}
