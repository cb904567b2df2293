//! The places of shim-pack valves in a damper.

use dashpot_core::characteristic::ShimPackValve;
use dashpot_core::parameters::{Hydraulics, Valve};
use dashpot_core::shim::Pack;

use crate::failure::Outcome;
use crate::published;

/// A valve of the paper: its name, the key of the damper file, its place and its table.
pub(super) struct Place {
    pub(super) name: &'static str,
    pub(super) section: &'static str,
    pub(super) valve: ShimPackValve,
    pub(super) of: fn(&Hydraulics) -> &Valve,
    pub(super) table: &'static str,
}

/// The valves of the paper.
pub(super) const PLACES: [Place; 3] = [
    Place {
        name: "piston extension",
        section: "valves.piston_extension",
        valve: ShimPackValve::PistonExtension,
        of: |hydraulics| &hydraulics.valves.piston_extension,
        table: published::TABLE_2,
    },
    Place {
        name: "piston compression",
        section: "valves.piston_compression",
        valve: ShimPackValve::PistonCompression,
        of: |hydraulics| &hydraulics.valves.piston_compression,
        table: published::TABLE_3,
    },
    Place {
        name: "foot compression",
        section: "valves.foot_compression",
        valve: ShimPackValve::FootCompression,
        of: |hydraulics| &hydraulics.valves.foot_compression,
        table: published::TABLE_4,
    },
];

impl Place {
    /// The pack here, if its file describes one.
    pub(super) fn pack(&self, hydraulics: &Hydraulics) -> Outcome<Option<Pack>> {
        let valve = (self.of)(hydraulics);
        if valve.shims_m.is_empty() {
            return Ok(None);
        }
        Ok(Some(Pack::new(self.section, valve)?))
    }
}

/// Radii from clamp to edge, `parts` equal parts.
pub(super) fn radii(valve: &Valve, parts: u32) -> impl Iterator<Item = f64> + use<> {
    let (clamp, free) = (valve.clamp_radius_m, valve.free_radius_m);
    (0..=parts).map(move |i| clamp + (free - clamp) * f64::from(i) / f64::from(parts))
}
