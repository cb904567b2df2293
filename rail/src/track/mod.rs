//! The track that a vehicle runs along: its layout, and what deviates from it.
//!
//! - [`Layout`]: straight, transition and circular [`Part`]s with cant.
//! - [`Irregularity`]: deviations over the distance, from a published [`Spectrum`] by [`Generation`] or from a measured file by [`measured`].
//! - [`Defect`]: a dip, a bump, a kink or a twist at one place.
//! - [`Track`]: all of them; [`Track::at`] gives the alignment and the displacements of both rails.
//!
//! Axes follow the layout: x forward, y right, z down, turned with the cant. Curvature is positive to the right, cant and cross level are
//! positive where the left rail is higher. The deviations of the rails do not contain the cant.
//!
//! ```
//! use dashpot_rail::track::{Defect, Generation, Layout, Part, Rails, Spectrum, Track};
//! let layout = Layout::new(&[
//!     Part::Straight { length_m: 200.0 },
//!     Part::Transition { length_m: 100.0 },
//!     Part::Circular { radius_m: 600.0, length_m: 400.0, cant_m: 0.1 },
//! ])?;
//! let irregularity = Generation { length_m: 700.0, ..Generation::of(Spectrum::fra(6)?) }.irregularity()?;
//! let dip = Defect::CosineDip { rails: Rails::Left, start_m: 100.0, length_m: 1.0, depth_m: 4e-3 };
//! let track = Track::new(layout, irregularity, vec![dip])?;
//!
//! let speed_m_per_s = 30.0;
//! let point = track.at(350.0);
//! assert_eq!(point.alignment.curvature_per_m, 1.0 / 600.0);
//! let [left, right] = point.rails.map(|rail| rail.displacement(speed_m_per_s));
//! assert!(left.vertical_velocity_m_per_s != right.vertical_velocity_m_per_s);
//! # Ok::<(), dashpot_rail::track::TrackError>(())
//! ```

mod defect;
mod error;
mod generation;
mod irregularity;
mod layout;
pub mod measured;
mod rails;
mod spectrum;

pub use defect::{Defect, Rails};
pub use error::{Place, TrackError};
pub use generation::{Band, Generation, MAX_SAMPLES, Seeds};
pub use irregularity::Irregularity;
pub use layout::{Alignment, Course, Layout, Part};
pub use rails::{Channels, RailDeviation};
pub use spectrum::{Density, Spectrum};

/// Layout, irregularity and defects of a track.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    layout: Layout,
    irregularity: Irregularity,
    defects: Vec<Defect>,
}

/// What a track is at one place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TrackPoint {
    /// Curvature and cant.
    pub alignment: Alignment,
    /// Displacements of the left and of the right rail from the layout.
    pub rails: [RailDeviation; 2],
}

impl Track {
    /// A track of checked parts; deviations of irregularity and defects add up.
    ///
    /// # Errors
    /// A defect with a length not within 0.05 to 1000 m, more than 0.2 m of displacement, or a rounding not within 1 mm to the length
    /// of the straights it joins.
    pub fn new(
        layout: Layout,
        irregularity: Irregularity,
        defects: Vec<Defect>,
    ) -> Result<Self, TrackError> {
        for (defect, number) in defects.iter().zip(1..) {
            defect.check(Place::Defect(number))?;
        }
        Ok(Self {
            layout,
            irregularity,
            defects,
        })
    }

    /// Alignment and displacements of the rails at a distance; does not allocate, and costs the same everywhere but for the defects' own formulas.
    #[inline]
    pub fn at(&self, distance_m: f64) -> TrackPoint {
        TrackPoint {
            alignment: self.layout.at(distance_m),
            rails: self.rails(distance_m),
        }
    }

    /// Displacements of the left and of the right rail at a distance.
    #[inline]
    pub fn rails(&self, distance_m: f64) -> [RailDeviation; 2] {
        let mut rails = self.irregularity.at(distance_m);
        for defect in &self.defects {
            for (rail, deviation) in rails.iter_mut().zip(defect.at(distance_m)) {
                *rail += deviation;
            }
        }
        rails
    }

    /// The layout.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The irregularity.
    pub fn irregularity(&self) -> &Irregularity {
        &self.irregularity
    }

    /// The defects.
    pub fn defects(&self) -> &[Defect] {
        &self.defects
    }
}
