//! Values along the track, linear between given distances.

use std::array::from_fn;

use super::error::{Place, TrackError, within};

/// Bounds of a distance, m.
const DISTANCE_M: [f64; 2] = [-1e7, 1e7];

/// Minimum distance between two points, m.
const SPACING_M: f64 = 1e-3;

/// Values at given distances: linear in between, constant before the first and behind the last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Polyline<const N: usize> {
    points: Vec<Point<N>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Point<const N: usize> {
    distance_m: f64,
    values: [f64; N],
    /// Change of each value per distance up to the next point.
    slopes: [f64; N],
}

/// Values at one distance, and their change per distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sloped<const N: usize> {
    pub values: [f64; N],
    pub slopes: [f64; N],
}

impl<const N: usize> Polyline<N> {
    /// Connects `points` of a distance, m, and its values; `None` if there are no points.
    ///
    /// # Errors
    /// Points less than 1 mm apart or not in order, or a value called `name` outside `allowed`.
    pub fn new(
        points: &[(f64, [f64; N])],
        place: fn(usize) -> Place,
        name: &'static str,
        allowed: [f64; 2],
    ) -> Result<Option<Self>, TrackError> {
        let mut least_m = DISTANCE_M[0];
        for (number, (distance_m, values)) in (1..).zip(points) {
            let bounds = [least_m, DISTANCE_M[1]];
            within(place(number), "distance_m", *distance_m, bounds)?;
            least_m = distance_m + SPACING_M;
            for value in values {
                within(place(number), name, *value, allowed)?;
            }
        }
        let next = points.iter().skip(1).map(Some).chain([None]);
        let with_slopes = points.iter().zip(next).map(|((distance_m, values), next)| {
            let slope = |k: usize| {
                next.map_or(0.0, |(end_m, end)| {
                    (end[k] - values[k]) / (end_m - distance_m)
                })
            };
            Point {
                distance_m: *distance_m,
                values: *values,
                slopes: from_fn(slope),
            }
        });
        let points: Vec<_> = with_slopes.collect();
        Ok((!points.is_empty()).then_some(Self { points }))
    }

    /// Returns the values at a distance. The number of comparisons is the logarithm of the number of points.
    #[inline]
    pub fn at(&self, distance_m: f64) -> Sloped<N> {
        let behind = self
            .points
            .partition_point(|point| point.distance_m <= distance_m);
        let Some(Point {
            distance_m: start_m,
            values,
            slopes,
        }) = behind.checked_sub(1).and_then(|last| self.points.get(last))
        else {
            return Sloped {
                values: self.points[0].values,
                slopes: [0.0; N],
            };
        };
        let ahead_m = distance_m - start_m;
        Sloped {
            values: from_fn(|k| values[k] + slopes[k] * ahead_m),
            slopes: *slopes,
        }
    }

    /// Returns the distances of the points, m.
    pub fn distances_m(&self) -> impl Iterator<Item = f64> + '_ {
        self.points.iter().map(|point| point.distance_m)
    }
}
