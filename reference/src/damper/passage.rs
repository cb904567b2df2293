//! Piston velocity under the working pressure of one direction.
//!
//! Pressures are gauge (Pa); velocities (m/s) are positive in the working direction.

use dashpot_core::parameters::Hydraulics;

use super::chambers::TwoChambers;
use super::paths::{Areas, Foot, PistonPaths};

/// Velocity as a function of the working pressure `P = (|F| - F_c)+/A` of one direction.
#[derive(Clone, Debug)]
pub(super) enum Passage {
    /// Extension: from the rod side to the piston side.
    Extension { piston: PistonPaths, area: f64 },
    /// Compression in which the same pressure acts on the piston valves and the foot valve.
    Lumped {
        piston: PistonPaths,
        foot: Box<FootLumped>,
    },
    /// Compression with separate pressures in both chambers.
    TwoChamber(Box<TwoChambers>),
}

/// Foot valve and piston area of [`Passage::Lumped`].
#[derive(Clone, Debug)]
pub(super) struct FootLumped {
    foot: Foot,
    area: f64,
}

impl Passage {
    pub(super) fn extension(hydraulics: &Hydraulics, areas: &Areas) -> Self {
        Self::Extension {
            piston: PistonPaths::new(hydraulics, &hydraulics.valves.piston_extension),
            area: areas.extension,
        }
    }

    pub(super) fn compression(hydraulics: &Hydraulics, areas: &Areas) -> Self {
        let piston = PistonPaths::new(hydraulics, &hydraulics.valves.piston_compression);
        let foot = Foot::new(hydraulics, areas.rod);
        match &hydraulics.two_chamber {
            None => Self::Lumped {
                piston,
                foot: Box::new(FootLumped {
                    foot,
                    area: areas.compression,
                }),
            },
            Some(two) => Self::TwoChamber(Box::new(TwoChambers {
                piston,
                foot,
                areas: *areas,
                vapour: two.vapour_pressure_pa,
            })),
        }
    }

    /// Working pressure up to which the piston does not move (Pa).
    pub(super) fn closed_up_to(&self) -> f64 {
        match self {
            Self::Extension { piston, .. } => piston.closed_up_to(),
            Self::Lumped { piston, foot } => piston.closed_up_to().min(foot.foot.closed_up_to()),
            Self::TwoChamber(chambers) => chambers.closed_up_to(),
        }
    }

    /// Working pressures up to `limit` (Pa) at which a valve opens and the velocity has a kink.
    pub(super) fn kinks(&self, limit: f64) -> Vec<f64> {
        match self {
            Self::Extension { piston, .. } => piston.openings().collect(),
            Self::Lumped { piston, foot } => {
                piston.openings().chain(foot.foot.openings()).collect()
            }
            Self::TwoChamber(chambers) => chambers.kinks(limit),
        }
    }

    /// Piston velocity (m/s) at the working pressure `closed + above` (Pa), with `closed` from [`Self::closed_up_to`].
    pub(super) fn velocity(&self, closed: f64, above: f64) -> f64 {
        let pressure = closed + above;
        match self {
            Self::Extension { piston, area } => piston.flow(pressure, pressure) / area,
            Self::Lumped { piston, foot } => {
                let density = piston.fluid.density(pressure);
                (piston.flow(pressure, pressure) + foot.foot.flow(pressure, 0.0, density))
                    / foot.area
            }
            Self::TwoChamber(chambers) => chambers.velocity(closed, above),
        }
    }
}
