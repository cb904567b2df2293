//! The track: its layout, and the deviations of the rails from it.
//!
//! - [`Layout`]: straight, transition and circular [`Part`]s with cant.
//! - [`Irregularity`]: random or measured deviations, from a published [`Spectrum`] by [`Generation`] or from a file by
//!   [`measured`].
//! - [`Defect`]: an isolated dip, bump, kink or twist.
//! - [`Track`]: the combination of all three. [`Track::at`] returns the alignment and the displacements of both rails.
//!
//! The axes follow the layout and roll with the cant: x forward, y right, z down. Curvature is positive to the right;
//! cant and cross level are positive if the left rail is higher. The deviations of the rails do not include the cant.
//!
//! ```
//! use dashpot_rail::track::{Defect, Generation, Layout, Part, Rails, Spectrum, Track};
//! let layout = Layout::new(&[
//!     Part::Straight { length_m: 200.0 },
//!     Part::Transition { length_m: 100.0 },
//!     Part::Circular { radius_m: 600.0, length_m: 400.0, cant_m: 0.1 },
//! ])?;
//! let irregularity = Generation::new(Spectrum::fra(6)?).with_length_m(700.0).irregularity()?;
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
pub use generation::{Band, Generation, Seeds};
pub use irregularity::{Irregularity, MAX_SAMPLES};
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

/// Alignment and rail displacements of a track at one distance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct TrackPoint {
    /// Curvature and cant.
    pub alignment: Alignment,
    /// Displacements of the left and the right rail from the layout.
    pub rails: [RailDeviation; 2],
}

impl Track {
    /// Builds a track. The deviations of irregularity and defects add up.
    ///
    /// # Errors
    /// A defect with a length outside 0.05 to 1000 m, a displacement above 0.2 m, or a rounding shorter than 1 mm or
    /// longer than one of the straight lines that it joins.
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

    /// Returns the alignment and the displacements of the rails at a distance.
    ///
    /// Does not allocate. Apart from the defects, the cost does not depend on the distance.
    #[inline]
    pub fn at(&self, distance_m: f64) -> TrackPoint {
        TrackPoint {
            alignment: self.layout.at(distance_m),
            rails: self.rails(distance_m),
        }
    }

    /// Returns the displacements of the left and the right rail at a distance.
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

    /// Returns the layout.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Returns the irregularity.
    pub fn irregularity(&self) -> &Irregularity {
        &self.irregularity
    }

    /// Returns the defects.
    pub fn defects(&self) -> &[Defect] {
        &self.defects
    }
}
