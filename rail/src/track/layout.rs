//! The designed line of a track: straight, transition and circular parts, with their cant.

use super::error::{Place, TrackError, within};

/// A part of a layout.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Part {
    /// Straight track without cant.
    Straight {
        /// Length, m.
        length_m: f64,
    },
    /// Clothoid with a linear cant ramp: curvature and cant vary linearly from those of the previous part to those of
    /// the next.
    Transition {
        /// Length, m.
        length_m: f64,
    },
    /// Constant curvature and cant.
    Circular {
        /// Radius of the centre line, positive in a right-hand curve, m.
        radius_m: f64,
        /// Length, m.
        length_m: f64,
        /// Height of the left rail above the right rail, m. It is positive in a right-hand curve, where the left rail
        /// is the outer rail.
        cant_m: f64,
    },
}

/// Bounds of a part's length, m.
const LENGTH_M: [f64; 2] = [0.1, 1e6];
/// Bounds of the magnitude of a radius, m. A larger radius counts as straight.
const RADIUS_M: [f64; 2] = [50.0, 1e6];
/// Bounds of the height of the outer rail above the inner rail, m. In some turnouts the inner rail is higher.
const CANT_M: [f64; 2] = [-0.1, 0.3];

/// Curvature and cant of a layout at one distance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Alignment {
    /// Curvature `k` of the centre line, positive to the right, 1/m.
    pub curvature_per_m: f64,
    /// `dk/ds`, 1/m^2; zero outside transitions.
    pub curvature_rate_per_m2: f64,
    /// Cant: height of the left rail above the right rail, m.
    pub cant_m: f64,
    /// Change of the cant per distance, dimensionless.
    pub cant_slope: f64,
}

/// A part in the form in which it is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Piece {
    start_m: f64,
    start: Alignment,
    /// Direction at the start, rad.
    heading_rad: f64,
    /// Integral of the direction from the distance 0 to the start, m.
    offset_m: f64,
}

/// The centre line at one distance: its curvature and cant, its heading and its lateral offset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Course {
    /// Curvature and cant.
    pub alignment: Alignment,
    /// Heading, positive to the right, rad: the integral of the curvature from the distance 0.
    pub heading_rad: f64,
    /// Integral of the heading from the distance 0, m. For small angles it is the lateral offset from the tangent at 0.
    pub offset_m: f64,
}

impl Piece {
    fn at(&self, distance_m: f64) -> Alignment {
        let t = distance_m - self.start_m;
        Alignment {
            curvature_per_m: self.start.curvature_per_m + self.start.curvature_rate_per_m2 * t,
            cant_m: self.start.cant_m + self.start.cant_slope * t,
            ..self.start
        }
    }

    #[inline]
    fn course(&self, distance_m: f64) -> Course {
        let t = distance_m - self.start_m;
        let Alignment {
            curvature_per_m: curvature,
            curvature_rate_per_m2: rate,
            ..
        } = self.start;
        Course {
            alignment: self.at(distance_m),
            heading_rad: self.heading_rad + t * (curvature + 0.5 * t * rate),
            offset_m: self.offset_m
                + t * (self.heading_rad + 0.5 * t * (curvature + t * rate / 3.0)),
        }
    }
}

/// Curvature and cant as functions of the distance. The first and the last part extend to infinity.
///
/// Curvature may jump between parts without a transition, as in turnouts; cant must be continuous. The layout has no
/// gradient, and cant does not change the height of the centre line.
///
/// ```
/// use dashpot_rail::track::{Layout, Part};
/// let layout = Layout::new(&[
///     Part::Straight { length_m: 100.0 },
///     Part::Transition { length_m: 80.0 },
///     Part::Circular { radius_m: 400.0, length_m: 200.0, cant_m: 0.12 },
/// ])?;
/// let middle = layout.at(140.0);
/// assert!((middle.curvature_per_m - 0.5 / 400.0).abs() < 1e-15);
/// assert!((middle.cant_m - 0.06).abs() < 1e-15);
/// # Ok::<(), dashpot_rail::track::TrackError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Layout {
    pieces: Vec<Piece>,
    length_m: f64,
}

impl Default for Layout {
    /// Returns straight track of infinite length.
    fn default() -> Self {
        Self {
            pieces: vec![Piece {
                start_m: 0.0,
                start: Alignment::default(),
                heading_rad: 0.0,
                offset_m: 0.0,
            }],
            length_m: 0.0,
        }
    }
}

impl Layout {
    /// Builds a layout from `parts` in order, starting at the distance 0.
    ///
    /// # Errors
    /// - no parts;
    /// - a length outside 0.1 m to 1000 km, or a radius outside 50 m to 1000 km;
    /// - an outer rail more than 0.3 m above or 0.1 m below the inner rail, or a cant that is not continuous;
    /// - a transition without a straight or circular part on each side, or between parts of the same curvature and
    ///   cant.
    pub fn new(parts: &[Part]) -> Result<Self, TrackError> {
        for (part, number) in parts.iter().zip(1..) {
            part.check(Place::Part(number))?;
        }
        let mut layout = Self {
            pieces: Vec::with_capacity(parts.len()),
            length_m: 0.0,
        };
        let mut end: Option<Alignment> = None;
        for (index, part) in parts.iter().enumerate() {
            let place = Place::Part(index + 1);
            let start = match part.constant() {
                Some(constant) => {
                    let before_m = end.map_or(constant.cant_m, |end| end.cant_m);
                    // The end of a transition differs by rounding only.
                    if (before_m - constant.cant_m).abs() > 1e-9 {
                        return Err(TrackError::CantJump {
                            place,
                            before_m,
                            after_m: constant.cant_m,
                        });
                    }
                    constant
                }
                None => {
                    let before = index.checked_sub(1).and_then(|i| parts[i].constant());
                    let after = parts.get(index + 1).and_then(Part::constant);
                    let (Some(before), Some(after)) = (before, after) else {
                        return Err(TrackError::TransitionAtEnd { place });
                    };
                    if before == after {
                        return Err(TrackError::NeedlessTransition { place });
                    }
                    let length_m = part.length_m();
                    Alignment {
                        curvature_rate_per_m2: (after.curvature_per_m - before.curvature_per_m)
                            / length_m,
                        cant_slope: (after.cant_m - before.cant_m) / length_m,
                        ..before
                    }
                }
            };
            let last = layout.pieces.last();
            let led = last.map_or(Course::default(), |last| last.course(layout.length_m));
            let piece = Piece {
                start_m: layout.length_m,
                start,
                heading_rad: led.heading_rad,
                offset_m: led.offset_m,
            };
            layout.length_m += part.length_m();
            end = Some(piece.at(layout.length_m));
            layout.pieces.push(piece);
        }
        if layout.pieces.is_empty() {
            return Err(TrackError::Empty);
        }
        Ok(layout)
    }

    /// Returns curvature and cant at a distance, and their slopes. Where two parts meet, those of the second part.
    #[inline]
    pub fn at(&self, distance_m: f64) -> Alignment {
        self.piece(distance_m).at(distance_m)
    }

    /// Returns the heading of the centre line, positive to the right, rad: the integral of the curvature from the
    /// distance 0.
    pub fn heading_rad(&self, distance_m: f64) -> f64 {
        self.course(distance_m).heading_rad
    }

    /// Returns the centre line at a distance.
    #[inline]
    pub fn course(&self, distance_m: f64) -> Course {
        self.piece(distance_m).course(distance_m)
    }

    /// Returns the distances at which parts start, m. There, curvature and the slopes of curvature and cant may jump.
    pub fn starts_m(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().map(|piece| piece.start_m)
    }

    /// Returns the total length of the parts, m.
    pub fn length_m(&self) -> f64 {
        self.length_m
    }

    #[inline]
    fn piece(&self, distance_m: f64) -> &Piece {
        let behind = self
            .pieces
            .partition_point(|piece| piece.start_m <= distance_m);
        &self.pieces[behind.saturating_sub(1)]
    }
}

impl Part {
    fn length_m(&self) -> f64 {
        match *self {
            Self::Straight { length_m }
            | Self::Transition { length_m }
            | Self::Circular { length_m, .. } => length_m,
        }
    }

    /// Curvature and cant of the part; `None` if they vary.
    fn constant(&self) -> Option<Alignment> {
        match *self {
            Self::Straight { .. } => Some(Alignment::default()),
            Self::Transition { .. } => None,
            Self::Circular {
                radius_m, cant_m, ..
            } => Some(Alignment {
                curvature_per_m: 1.0 / radius_m,
                cant_m,
                ..Alignment::default()
            }),
        }
    }

    fn check(&self, place: Place) -> Result<(), TrackError> {
        within(place, "length_m", self.length_m(), LENGTH_M)?;
        if let Self::Circular {
            radius_m, cant_m, ..
        } = *self
        {
            within(place, "magnitude of radius_m", radius_m.abs(), RADIUS_M)?;
            let outer_up = [CANT_M[0], CANT_M[1]];
            let allowed = if radius_m > 0.0 {
                outer_up
            } else {
                [-outer_up[1], -outer_up[0]]
            };
            within(
                place,
                "cant_m (left rail above right rail)",
                cant_m,
                allowed,
            )?;
        }
        Ok(())
    }
}
