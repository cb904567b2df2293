//! The track: its layout, and the deviations of the rails from it.
//!
//! - [`Layout`]: straight, transition and circular [`Part`]s with cant.
//! - [`Irregularity`]: random or measured deviations, from a published [`Spectrum`] by [`Generation`] or from a file by
//!   [`measured`].
//! - [`Defect`]: an isolated dip, bump, kink or twist.
//! - [`Track`]: the combination of all three, with changes of gauge and friction along the track. [`Track::at`] returns
//!   the alignment and the displacements of both rails, and [`Track::displacements`] what the contact needs of the
//!   rails.
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
mod polyline;
mod rails;
mod spectrum;

pub use defect::{Defect, Rails};
pub use error::{Place, TrackError};
pub use generation::{Band, Generation, Seeds};
pub use irregularity::{Irregularity, MAX_SAMPLES};
pub use layout::{Alignment, Course, Layout, Part};
pub use rails::{Channels, RailDeviation};
pub use spectrum::{Density, Spectrum};

use polyline::Polyline;

use crate::contact::RailDisplacement;

/// Bounds of a change of the gauge, m.
const GAUGE_CHANGE_M: [f64; 2] = [-0.1, 0.1];
/// Bounds of a factor on the friction coefficient.
const FRICTION_RATIO: [f64; 2] = [0.0, 1000.0];

/// Layout, irregularity, defects, gauge and friction of a track.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    layout: Layout,
    irregularity: Irregularity,
    defects: Vec<Defect>,
    /// Change of the gauge, m.
    gauge: Option<Polyline<1>>,
    /// Factors on the friction coefficient of the left and the right rail.
    friction: Option<Polyline<2>>,
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
            gauge: None,
            friction: None,
        })
    }

    /// Widens the gauge by `change_m` at each `[distance_m, change_m]`, half on each rail: linear in between, constant
    /// before the first and behind the last point. Without points, the gauge does not change.
    ///
    /// # Errors
    /// Points less than 1 mm apart or not in order, or a change outside -0.1 to 0.1 m.
    ///
    /// ```
    /// use dashpot_rail::track::Track;
    /// let track = Track::default().with_gauge(&[[100.0, 0.0], [110.0, 0.02]])?;
    /// let [left, right] = track.rails(105.0);
    /// assert!((right.lateral_m - 5e-3).abs() < 1e-15 && (right.lateral_slope - 1e-3).abs() < 1e-15);
    /// assert_eq!(left.lateral_m, -right.lateral_m);
    /// # Ok::<(), dashpot_rail::track::TrackError>(())
    /// ```
    pub fn with_gauge(mut self, points_m: &[[f64; 2]]) -> Result<Self, TrackError> {
        let points: Vec<_> = points_m
            .iter()
            .map(|[at_m, change_m]| (*at_m, [*change_m]))
            .collect();
        self.gauge = Polyline::new(
            &points,
            Place::Gauge,
            "change of the gauge, m",
            GAUGE_CHANGE_M,
        )?;
        Ok(self)
    }

    /// Multiplies the friction coefficient of the contact by `left` and `right` at each `[distance_m, left, right]`:
    /// linear in between, constant before the first and behind the last point. Without points, both factors are 1.
    ///
    /// # Errors
    /// Points less than 1 mm apart or not in order, or a factor outside 0 to 1000.
    ///
    /// ```
    /// use dashpot_rail::track::Track;
    /// let track = Track::default().with_friction(&[[0.0, 1.0, 1.0], [10.0, 1.0, 0.5]])?;
    /// let [left, right] = track.displacements(5.0, 20.0);
    /// assert_eq!([left.friction_ratio, right.friction_ratio], [1.0, 0.75]);
    /// # Ok::<(), dashpot_rail::track::TrackError>(())
    /// ```
    pub fn with_friction(mut self, points: &[[f64; 3]]) -> Result<Self, TrackError> {
        let points: Vec<_> = points
            .iter()
            .map(|[at_m, left, right]| (*at_m, [*left, *right]))
            .collect();
        self.friction = Polyline::new(&points, Place::Friction, "friction ratio", FRICTION_RATIO)?;
        Ok(self)
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
        if let Some(gauge) = &self.gauge {
            let at = gauge.at(distance_m);
            let [change, slope] = [at.values[0], at.slopes[0]].map(|gauge| Channels {
                gauge,
                ..Channels::default()
            });
            for (rail, deviation) in rails
                .iter_mut()
                .zip(RailDeviation::left_and_right(&change, &slope))
            {
                *rail += deviation;
            }
        }
        rails
    }

    /// Returns the displacements and the friction of both rails under a wheelset at a distance, which runs at
    /// `speed_m_per_s`. Does not allocate.
    #[inline]
    pub fn displacements(&self, distance_m: f64, speed_m_per_s: f64) -> [RailDisplacement; 2] {
        let mut rails = self
            .rails(distance_m)
            .map(|rail| rail.displacement(speed_m_per_s));
        for (rail, ratio) in rails.iter_mut().zip(self.friction_ratios(distance_m)) {
            rail.friction_ratio = ratio;
        }
        rails
    }

    /// Returns the factors of the left and the right rail on the friction coefficient of the contact at a distance.
    #[inline]
    pub fn friction_ratios(&self, distance_m: f64) -> [f64; 2] {
        let friction = self.friction.as_ref();
        friction.map_or([1.0; 2], |friction| friction.at(distance_m).values)
    }

    /// Returns the distances at which the slope of the gauge or of the friction changes, m.
    pub fn bends_m(&self) -> impl Iterator<Item = f64> + '_ {
        let gauge = self.gauge.iter().flat_map(Polyline::distances_m);
        gauge.chain(self.friction.iter().flat_map(Polyline::distances_m))
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
