//! Elastic contact of a wheel, computed on strips of its profile.
//!
//! The patch is divided into strips along the rolling direction. Each has a half-ellipse of pressure; together they
//! deflect wheel and rail like elastic half-spaces. The loads on the strips follow from the condition that loaded
//! strips touch and others do not enter the rail (Knothe, Le The 1984, "A contribution to the calculation of the
//! contact stress distribution between two elastic bodies of revolution with non-elliptical contact area"). Such a
//! problem has one solution, and it is a continuous function of the gaps, so forces do not jump where patches appear,
//! merge or part.

mod connection;
mod equations;
mod gap;
mod half_space;
mod lengths;
mod normal;
mod octave_table;
mod patch;
mod steps;
mod strips;
#[cfg(test)]
mod tests;

pub(super) use gap::Gap;
pub use normal::{Given, NormalContact};
pub use patch::ElasticPatch;
pub use strips::{Fineness, TurnedStrips};

use super::geometry::ContactGeometry;
use super::zones::ZONES;

/// Maximum reach of a gap, m. A wheel that would need more has no contact.
const MAX_REACH_M: f64 = 0.1;

impl ContactGeometry {
    /// Computes the elastic patch in each zone of a wheel at a lateral shift, from the flange to the field side.
    ///
    /// `contact` holds the previous solution, from which the new one starts; a default one will do.
    ///
    /// ```
    /// use dashpot_rail::contact::elastic::{Fineness, Given, NormalContact, TurnedStrips};
    /// use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
    /// let pair = Pair::standard(Installation::default())?;
    /// let geometry = ContactGeometry::new(pair, Steel::default())?;
    /// let wheel = TurnedStrips::new(geometry.pair(), 0.0, 0.0, Fineness::Medium);
    /// let mut contact = NormalContact::default();
    /// let patches = geometry.elastic_patches(&wheel, -5e-3, Given::LoadN(100e3), &mut contact);
    /// let load_n: f64 = patches.iter().map(|patch| patch.load_n).sum();
    /// assert!((load_n - 100e3).abs() < 10.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn elastic_patches(
        &self,
        wheel: &TurnedStrips<'_>,
        lateral_m: f64,
        given: Given,
        contact: &mut NormalContact,
    ) -> [ElasticPatch; ZONES] {
        let mut gap = Gap::default();
        match given {
            Given::DepthM(depth_m) => {
                gap.fill(wheel, lateral_m, |_| -depth_m);
                contact.solve(&gap, self.steel(), given);
            }
            Given::LoadN(load_n) => {
                let mut reach_m = Gap::usual_reach_m(load_n);
                loop {
                    gap.fill(wheel, lateral_m, |highest_m| highest_m - reach_m);
                    contact.solve(&gap, self.steel(), given);
                    if gap.holds(contact.depth_m) || reach_m > MAX_REACH_M {
                        break;
                    }
                    reach_m *= 2.0;
                }
            }
        }
        self.patches_in(&gap, lateral_m, contact)
    }

    /// The elastic patch in each zone of a solved contact.
    pub(super) fn patches_in(
        &self,
        gap: &Gap,
        lateral_m: f64,
        contact: &NormalContact,
    ) -> [ElasticPatch; ZONES] {
        contact.patches(gap, self.pair(), &self.zones().ends_m(lateral_m))
    }
}
