//! Quantities that change over time.

/// Quantity that is constant or goes in straight lines from value to value.
///
/// ```
/// use dashpot_files::case::Course;
/// let mut speed = Course::new([50.0]);
/// speed.then(2.0, 10.0, [30.0]);
/// assert_eq!([1.0, 7.0, 20.0].map(|time_s| speed.at(time_s)[0]), [50.0, 40.0, 30.0]);
/// assert_eq!(speed.integral(12.0), [100.0 + 400.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Course<const N: usize> {
    /// Times, s, in ascending order, and values. A jump has two knots at one time.
    knots: Vec<(f64, [f64; N])>,
}

impl<const N: usize> Course<N> {
    /// Constant from the time 0.
    pub fn new(start: [f64; N]) -> Self {
        Self {
            knots: vec![(0.0, start)],
        }
    }

    /// Adds a change to `value` from `time_s` on, which takes `ramp_s`. It ends an earlier change that is not over yet.
    pub fn then(&mut self, time_s: f64, ramp_s: f64, value: [f64; N]) {
        let before = self.at(time_s);
        self.knots.retain(|(knot_s, _)| *knot_s < time_s);
        self.knots.push((time_s, before));
        self.knots.push((time_s + ramp_s, value));
    }

    /// Value at a time; at a jump, the value after it.
    pub fn at(&self, time_s: f64) -> [f64; N] {
        let next = self.knots.partition_point(|(knot_s, _)| *knot_s <= time_s);
        let Some(&(from_s, from)) = next.checked_sub(1).and_then(|last| self.knots.get(last))
        else {
            return self.knots[0].1;
        };
        let Some((to_s, to)) = self.knots.get(next) else {
            return from;
        };
        let share = (time_s - from_s) / (to_s - from_s);
        std::array::from_fn(|i| from[i] + share * (to[i] - from[i]))
    }

    /// Integral from 0 to `end_s`.
    pub fn integral(&self, end_s: f64) -> [f64; N] {
        let mut sum = [0.0; N];
        let ends = self.knots.iter().skip(1).map(|(knot_s, _)| *knot_s);
        for (&(from_s, _), to_s) in self.knots.iter().zip(ends.chain([f64::INFINITY])) {
            let to_s = to_s.min(end_s);
            if to_s <= from_s {
                continue;
            }
            // In the middle, because the value may jump at an end.
            let middle = self.at(0.5 * (from_s + to_s));
            for (sum, middle) in sum.iter_mut().zip(middle) {
                *sum += middle * (to_s - from_s);
            }
        }
        sum
    }

    /// Largest value of the first component.
    pub fn max(&self) -> f64 {
        let values = self.knots.iter().map(|(_, value)| value[0]);
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Smallest value of the first component.
    pub fn min(&self) -> f64 {
        let values = self.knots.iter().map(|(_, value)| value[0]);
        values.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::Course;

    #[test]
    fn a_later_change_starts_where_the_earlier_one_has_got_to() {
        let mut course = Course::new([0.0, 1.0]);
        course.then(1.0, 4.0, [8.0, 1.0]);
        course.then(3.0, 2.0, [0.0, 2.0]);
        assert_eq!(course.at(3.0), [4.0, 1.0]);
        assert_eq!(course.at(4.0), [2.0, 1.5]);
        assert_eq!(course.at(9.0), [0.0, 2.0]);
        assert_eq!(course.integral(5.0)[0], 4.0 + 4.0);
    }

    #[test]
    fn a_jump_has_its_new_value_at_its_time() {
        let mut course = Course::new([1.0]);
        course.then(2.0, 0.0, [3.0]);
        assert_eq!(
            [1.999, 2.0, 2.001].map(|time_s| course.at(time_s)[0]),
            [1.0, 3.0, 3.0]
        );
        assert_eq!(course.integral(4.0), [2.0 + 6.0]);
        assert_eq!([course.min(), course.max()], [1.0, 3.0]);
        // A change at the start replaces the first value.
        course.then(0.0, 0.0, [5.0]);
        assert_eq!(course.at(0.0), [5.0]);
    }
}
