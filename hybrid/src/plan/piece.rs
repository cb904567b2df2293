//! A short interval of frequency, over which the loop is a pair of cubics.

use nalgebra::Complex;

type C64 = Complex<f64>;

/// Factor on the error of a cubic at the middle of its interval, where it is largest if the fourth derivative is
/// constant.
const SAFETY: f64 = 4.0;
/// Maximum error of the derivative of a cubic over its interval, relative to the maximum error of the cubic:
/// `384 sqrt(3)/216`, if the fourth derivative is constant.
const ERROR_OF_DERIVATIVE: f64 = 3.1;
/// Ratios `C(3, i) C(3, j)/C(6, i + j)` of the Bernstein form of a product of two cubics.
const PRODUCT: [[f64; 4]; 4] = [
    [1.0, 0.5, 0.2, 0.05],
    [0.5, 0.6, 0.45, 0.2],
    [0.2, 0.45, 0.6, 0.5],
    [0.05, 0.2, 0.5, 1.0],
];

/// A value and its derivative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub value: C64,
    pub slope: C64,
}

/// A complex cubic over an interval in Bernstein form: it stays in the convex hull of its four points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    points: [C64; 4],
    /// Bound of its distance from the function.
    error: f64,
}

impl Cubic {
    /// The cubic with the values and slopes at both ends of an interval of this width; `middle` is the function's value
    /// there. `rounding` is the relative error of the values.
    pub fn new(width: f64, [start, end]: [Jet; 2], middle: C64, rounding: f64) -> Self {
        let points = [
            start.value,
            start.value + start.slope * (width / 3.0),
            end.value - end.slope * (width / 3.0),
            end.value,
        ];
        let at_middle = (points[0] + points[3] + (points[1] + points[2]) * 3.0) * 0.125;
        let error = SAFETY * (at_middle - middle).norm();
        let mut cubic = Self { points, error };
        cubic.error += rounding * cubic.max();
        cubic
    }

    /// Largest magnitude of a point, a bound of the cubic.
    pub fn max(&self) -> f64 {
        self.points.iter().map(|p| p.norm()).fold(0.0, f64::max)
    }

    /// Lower bound of the magnitude of the function and the direction in which it is at least that far from zero.
    pub fn min(&self) -> (f64, C64) {
        let sum: C64 = self.points.iter().sum();
        let direction = sum / sum.norm().max(f64::MIN_POSITIVE);
        let along = self.points.iter().map(|p| (p * direction.conj()).re);
        (along.fold(f64::INFINITY, f64::min) - self.error, direction)
    }

    fn sum(&self, other: &Self) -> Self {
        Self {
            points: std::array::from_fn(|i| self.points[i] + other.points[i]),
            error: self.error + other.error,
        }
    }

    /// Bernstein form of the squared magnitude.
    fn square(&self) -> [f64; 7] {
        let mut square = [0.0; 7];
        for (i, first) in self.points.iter().enumerate() {
            for (j, second) in self.points.iter().enumerate() {
                square[i + j] += PRODUCT[i][j] * (first * second.conj()).re;
            }
        }
        square
    }

    /// Bounds of the errors of the squared magnitude and of its derivative over the interval.
    fn error_of_square(&self) -> [f64; 2] {
        let (error, max) = (self.error, self.max());
        let steps = self.points.windows(2).map(|two| (two[1] - two[0]).norm());
        let slope = 3.0 * steps.fold(0.0, f64::max);
        [
            error * (2.0 * max + error),
            2.0 * error * (slope + ERROR_OF_DERIVATIVE * (max + error)),
        ]
    }
}

/// Phase change of `u + v` over the interval, rad. `None` if the interval is too long to exclude a zero.
pub(super) fn phase_change(u: &Cubic, v: &Cubic) -> Option<f64> {
    let sum = u.sum(v);
    let (min, direction) = sum.min();
    // In a half plane the phase is that between the ends.
    let phase = |point: C64| (point * direction.conj()).arg();
    (min > 0.0).then(|| phase(sum.points[3]) - phase(sum.points[0]))
}

/// Whether `|u|` can equal `|v|` in the interval, and then once at most. `None` if the interval is too long to decide.
pub(super) fn can_cross(u: &Cubic, v: &Cubic) -> Option<bool> {
    let (of_u, of_v) = (u.square(), v.square());
    let difference: [f64; 7] = std::array::from_fn(|k| of_u[k] - of_v[k]);
    let [[value_u, slope_u], [value_v, slope_v]] = [u.error_of_square(), v.error_of_square()];
    let (value, slope) = (value_u + value_v, slope_u + slope_v);
    // A polynomial is between the smallest and the largest coefficient of its Bernstein form.
    if difference.iter().all(|d| *d > value) || difference.iter().all(|d| *d < -value) {
        return Some(false);
    }
    let steps: [f64; 6] = std::array::from_fn(|k| 6.0 * (difference[k + 1] - difference[k]));
    let is_monotonic = steps.iter().all(|s| *s > slope) || steps.iter().all(|s| *s < -slope);
    is_monotonic.then_some(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cubic of a function over the interval from `start` to `end`; `function` returns value and slope.
    fn cubic(function: impl Fn(f64) -> (C64, C64), start: f64, end: f64) -> Cubic {
        let jet = |t| {
            let (value, slope) = function(t);
            Jet { value, slope }
        };
        let middle = function(0.5 * (start + end)).0;
        Cubic::new(end - start, [jet(start), jet(end)], middle, 1e-10)
    }

    fn spiral(t: f64) -> (C64, C64) {
        let rate = C64::new(-0.3, 2.0);
        let value = (rate * t).exp();
        (value, value * rate)
    }

    fn one(_: f64) -> (C64, C64) {
        (C64::from(1.0), C64::from(0.0))
    }

    #[test]
    fn bounds_hold_between_the_ends() {
        let (start, end) = (0.2, 0.9);
        let found = cubic(spiral, start, end);
        let (min, direction) = found.min();
        for k in 0..=100 {
            let value = spiral(start + (end - start) * f64::from(k) / 100.0).0;
            assert!(value.norm() <= found.max() + found.error);
            assert!((value * direction.conj()).re >= min);
        }
        assert!(min > 0.5, "{min}");
        let cubic_squared: f64 = found.square().iter().sum::<f64>() / 7.0;
        let samples =
            (0..1000).map(|k| spiral(start + (end - start) * (f64::from(k) + 0.5) / 1e3).0);
        let mean = samples.map(|value| value.norm_sqr()).sum::<f64>() / 1e3;
        let [allowed, _] = found.error_of_square();
        assert!(allowed < 0.1 && (cubic_squared - mean).abs() < allowed);
    }

    /// `|exp(-0.3 t)| = 1` at 0 only.
    #[test]
    fn a_crossing_is_seen_in_the_interval_that_has_it() {
        let ask = |start, end| can_cross(&cubic(spiral, start, end), &cubic(one, start, end));
        assert_eq!(ask(-0.2, 0.2), Some(true));
        assert_eq!(ask(0.1, 0.4), Some(false));
        assert_eq!(ask(-0.4, -0.1), Some(false));
        assert_eq!(ask(-2.0, 2.0), None);
    }

    #[test]
    fn a_phase_change_is_that_of_the_function_unless_it_may_be_zero() {
        let nothing = cubic(|_| (C64::from(0.0), C64::from(0.0)), 0.0, 0.5);
        let change = phase_change(&cubic(spiral, 0.0, 0.5), &nothing).unwrap();
        assert!((change - 1.0).abs() < 1e-12);
        let through_zero = |t: f64| (C64::new(t, 1e-12), C64::from(1.0));
        assert_eq!(
            phase_change(&cubic(through_zero, -0.1, 0.1), &nothing),
            None
        );
        assert!(phase_change(&cubic(through_zero, 1e-3, 0.1), &nothing).is_some());
    }
}
