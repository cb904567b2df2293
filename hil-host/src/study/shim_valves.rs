//! The shim-pack valves of a damper, each with its published table.

use dashpot_core::characteristic::ShimPackValve;
use dashpot_core::parameters::{Hydraulics, Valve};
use dashpot_core::shim::Pack;

use super::StudyError;
use super::published::{self, Deflection, deflections};

/// One of the places of a shim-pack valve in a damper.
pub struct Place {
    /// Name for people.
    pub name: &'static str,
    /// Key of the damper file.
    pub section: &'static str,
    /// The valve in the core's characteristic.
    pub valve: ShimPackValve,
    /// Number of the source paper's table of its deflections.
    pub table: u8,
    of: fn(&Hydraulics) -> &Valve,
    published: &'static str,
}

/// The places.
pub const PLACES: [Place; 3] = [
    Place {
        name: "piston extension",
        section: "valves.piston_extension",
        valve: ShimPackValve::PistonExtension,
        of: |hydraulics| &hydraulics.valves.piston_extension,
        table: 2,
        published: published::TABLE_2,
    },
    Place {
        name: "piston compression",
        section: "valves.piston_compression",
        valve: ShimPackValve::PistonCompression,
        of: |hydraulics| &hydraulics.valves.piston_compression,
        table: 3,
        published: published::TABLE_3,
    },
    Place {
        name: "foot compression",
        section: "valves.foot_compression",
        valve: ShimPackValve::FootCompression,
        of: |hydraulics| &hydraulics.valves.foot_compression,
        table: 4,
        published: published::TABLE_4,
    },
];

impl Place {
    /// The valve here.
    pub fn valve_of<'a>(&self, hydraulics: &'a Hydraulics) -> &'a Valve {
        (self.of)(hydraulics)
    }

    /// The pack here, if its file describes one.
    ///
    /// # Errors
    /// A pack that disc theory does not hold for.
    pub fn pack(&self, hydraulics: &Hydraulics) -> Result<Option<Pack>, StudyError> {
        let valve = self.valve_of(hydraulics);
        if valve.shims_m.is_empty() {
            return Ok(None);
        }
        Ok(Some(Pack::new(self.section, valve)?))
    }

    /// Edge compliance (m/Pa) of the pack here by disc theory, uniform pressure.
    ///
    /// # Errors
    /// As [`Place::pack`].
    pub fn theory_m_per_pa(&self, hydraulics: &Hydraulics) -> Result<Option<f64>, StudyError> {
        let edge = self.valve_of(hydraulics).free_radius_m;
        let pack = self.pack(hydraulics)?;
        Ok(pack.map(|pack| pack.compliance_m_per_pa(edge)))
    }

    /// Rows of the published table.
    ///
    /// # Errors
    /// The table in the program is not as it was shipped.
    pub fn published(&self) -> Result<Vec<Deflection>, StudyError> {
        deflections(self.published)
    }
}

/// Disc theory over the published deflection, uniform pressure, at the table's highest pressure.
pub fn theory_over_published(theory_m_per_pa: f64, published: &[Deflection]) -> Option<f64> {
    let row = published.last()?;
    Some(theory_m_per_pa * row.pressure_pa() / row.theory_uniform_m())
}

/// The first erratum of the source paper, with the figures of the damper published there.
///
/// # Errors
/// As [`Place::pack`] and [`Place::published`].
pub fn erratum(paper: &Hydraulics) -> Result<String, StudyError> {
    let ratio = |place: &Place| -> Result<String, StudyError> {
        let theory = place.theory_m_per_pa(paper)?;
        let published = place.published()?;
        let ratio = theory.and_then(|theory| theory_over_published(theory, &published));
        Ok(ratio.map_or_else(|| "-".into(), |ratio| format!("{ratio:.0}")))
    };
    let [extension, compression, foot] = &PLACES;
    Ok(format!(
        "Tables 2-4 of the paper do not follow from its Table 1: the disc theory gives {}, {} and {} \
         times the tabulated deflections, and no bonded stack fits either.",
        ratio(extension)?,
        ratio(compression)?,
        ratio(foot)?
    ))
}
