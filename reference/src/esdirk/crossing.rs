//! Location of an event within a step: the first time at which one of several functions is no longer positive.

/// Width of the final interval, relative to the magnitude of its times.
const RELATIVE_WIDTH: f64 = 100.0 * f64::EPSILON;

/// Event functions at both ends of a time interval.
#[derive(Clone, Debug, Default)]
pub(super) struct Bracket {
    pub(super) low: Vec<f64>,
    pub(super) high: Vec<f64>,
    middle: Vec<f64>,
}

/// An event: its time, and the index of its function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub(super) time: f64,
    pub(super) index: usize,
}

impl Bracket {
    pub(super) fn new(functions: usize) -> Self {
        Self {
            low: vec![0.0; functions],
            high: vec![0.0; functions],
            middle: vec![0.0; functions],
        }
    }

    /// Moves the start of the interval to its end.
    pub(super) fn advance(&mut self) {
        std::mem::swap(&mut self.low, &mut self.high);
    }

    /// Finds the first event between two times.
    ///
    /// The search narrows an interval around the event down to rounding and returns its upper end. `evaluate` writes
    /// the values of the functions at a time. The search uses secants (Illinois variant) on the function that linear
    /// interpolation predicts to cross first, as CVODE does (Hindmarsh et al. 2005).
    pub(super) fn locate(
        &mut self,
        (mut start, mut end): (f64, f64),
        mut evaluate: impl FnMut(f64, &mut [f64]),
    ) -> Option<Crossing> {
        let mut index = first_crossing(&self.low, &self.high)?;
        let width = RELATIVE_WIDTH * (end.abs() + (end - start).abs());
        // Weight of the function at the start; it changes if the same end moves twice in succession.
        let mut weight = 1.0;
        let mut end_moved = None;
        while end - start > width && self.high[index] < 0.0 {
            let (low, high) = (self.low[index], self.high[index]);
            let secant = end - (end - start) * high / (high - weight * low);
            let middle = inside(secant, start, end, width);
            evaluate(middle, &mut self.middle);
            let found = first_crossing(&self.low, &self.middle);
            if let Some(crossing) = found {
                (end, index) = (middle, crossing);
                std::mem::swap(&mut self.high, &mut self.middle);
            } else {
                start = middle;
                std::mem::swap(&mut self.low, &mut self.middle);
            }
            weight = match (end_moved, found.is_some()) {
                (Some(true), true) => 0.5 * weight,
                (Some(false), false) => 2.0 * weight,
                _ => 1.0,
            };
            end_moved = Some(found.is_some());
        }
        Some(Crossing { time: end, index })
    }
}

/// Moves a point between two times away from both ends.
fn inside(point: f64, start: f64, end: f64, width: f64) -> f64 {
    let distance = end - start;
    let away = if distance > 5.0 * width {
        0.1 * distance
    } else {
        0.5 * width
    };
    if point - start < 0.5 * width {
        start + away
    } else if end - point < 0.5 * width {
        end - away
    } else {
        point
    }
}

/// Index of the function that crosses first according to linear interpolation.
fn first_crossing(low: &[f64], high: &[f64]) -> Option<usize> {
    let mut first = None;
    let mut largest_share = 0.0;
    for (index, (low, high)) in low.iter().zip(high).enumerate() {
        if *low > 0.0 && *high <= 0.0 {
            let share = high / (high - low);
            if first.is_none() || share > largest_share {
                (first, largest_share) = (Some(index), share);
            }
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    fn located<const N: usize>(functions: impl Fn(f64) -> [f64; N]) -> Option<Crossing> {
        let mut bracket = Bracket::new(N);
        bracket.low.copy_from_slice(&functions(1.0));
        bracket.high.copy_from_slice(&functions(2.0));
        bracket.locate((1.0, 2.0), |time, values| {
            values.copy_from_slice(&functions(time));
        })
    }

    #[test]
    fn the_first_of_two_events_is_found() {
        // According to linear interpolation, the second function would cross first.
        let crossing = located(|t| [2.0 - t * t, (1.5 - t) * t.powi(8)]).expect("an event");
        assert_eq!(crossing.index, 0);
        let past = crossing.time - 2f64.sqrt();
        assert!((0.0..1e-13).contains(&past), "{past:e}");
    }

    #[test]
    fn functions_that_stay_positive_or_become_so_are_no_events() {
        assert_eq!(located(|t| [t, t - 1.5]), None);
        assert_eq!(located(|_| []), None);
    }

    #[test]
    fn a_zero_at_the_end_is_an_event() {
        let end = Crossing {
            time: 2.0,
            index: 0,
        };
        assert_eq!(located(|t| [2.0 - t]), Some(end));
    }
}
