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
mod half_space;
mod lengths;
mod normal;
mod octave_table;
mod patch;
mod strips;
#[cfg(test)]
mod tests;

pub use normal::{Given, NormalContact};
pub use patch::ElasticPatch;
pub use strips::{Fineness, TurnedStrips};

use super::geometry::ContactGeometry;
use super::zones::ZONES;

impl ContactGeometry {
    /// Computes the elastic patch in each zone of a wheel at a lateral shift, from the flange to the field side.
    ///
    /// `contact` holds the previous solution, from which the new one starts; a default one will do.
    ///
    /// ```
    /// use dashpot_rail::contact::elastic::{Fineness, Given, NormalContact, TurnedStrips};
    /// use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
    /// let pair = Pair::standard(Installation::default())?;
    /// let geometry = ContactGeometry::new(pair, Steel::default(), 100e3)?;
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
        let mut heights = Vec::new();
        wheel.heights(lateral_m, &mut heights);
        contact.solve(&wheel.strips, &heights, self.steel(), given);
        contact.patches(self.pair(), &wheel.strips, &self.zones().ends_m(lateral_m))
    }
}
