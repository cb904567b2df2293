//! When a fitted line reaches a limit, with the uncertainty: Fieller's theorem (Fieller 1954).

use super::fit::Line;

/// A limit of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Value of the limit.
    pub value: f64,
    /// True if values above the limit are not allowed, false if values below it are not.
    pub is_upper: bool,
}

/// When the line reaches the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Forecast {
    /// At the last reading the line is beyond the limit.
    Beyond {
        /// Abscissa at which it crossed the limit; `None` if no change is seen.
        since: Option<f64>,
        /// True if the whole confidence interval is beyond the limit.
        is_sure: bool,
    },
    /// The line moves towards the limit, and its slope differs from zero.
    Reached {
        /// Abscissa at which the line reaches the limit.
        at: f64,
        /// Earliest abscissa of the confidence interval; before the last reading if the limit may already be reached.
        earliest: f64,
        /// Latest abscissa of the confidence interval.
        latest: f64,
    },
    /// No change towards the limit is seen.
    NotInSight {
        /// First abscissa from the last reading on at which the limit is within the confidence interval of the line;
        /// `None` if there is none.
        earliest: Option<f64>,
    },
}

impl Forecast {
    /// Inverts the confidence band of a line whose last reading is at `last`.
    pub fn new(line: &Line, limit: Limit, last: f64) -> Self {
        // Positive: the distance that is left, and how it grows.
        let sign = if limit.is_upper { 1.0 } else { -1.0 };
        let now = line.at(last);
        let left = sign * (limit.value - now.value);
        let closing = sign * line.slope;
        let crossing = line.centre + (limit.value - line.value) / line.slope;
        let [first, second] = band_crossings(line, limit.value).unwrap_or([f64::NAN; 2]);
        if left <= 0.0 {
            return Self::Beyond {
                since: (line.has_changed() && closing > 0.0).then_some(crossing),
                is_sure: left < -(now.high - now.value),
            };
        }
        if line.has_changed() && closing > 0.0 {
            return Self::Reached {
                at: crossing,
                earliest: first,
                latest: second,
            };
        }
        let is_possible_now = (now.low..=now.high).contains(&limit.value);
        let later = [first, second].into_iter().find(|x| *x > last);
        Self::NotInSight {
            earliest: if is_possible_now { Some(last) } else { later },
        }
    }
}

/// Returns the two abscissas, in order, at which an end of the confidence band is at `limit`; `None` if there are none.
///
/// If the slope differs from zero, the limit is within the band between them, otherwise outside.
fn band_crossings(line: &Line, limit: f64) -> Option<[f64; 2]> {
    let square = line.quantile * line.quantile;
    let off = line.value - limit;
    let a = line.slope * line.slope - square * line.slope_variance;
    let b = off * line.slope;
    let c = off * off - square * line.value_variance;
    let discriminant = b * b - a * c;
    if discriminant < 0.0 || a == 0.0 {
        return None;
    }
    // The root of the larger magnitude first, because the other one would lose its digits.
    let sum = -(b + discriminant.sqrt().copysign(b));
    let roots = if sum == 0.0 {
        [0.0, 0.0]
    } else {
        [sum / a, c / sum]
    };
    let roots = roots.map(|from_centre| line.centre + from_centre);
    Some([roots[0].min(roots[1]), roots[0].max(roots[1])])
}
