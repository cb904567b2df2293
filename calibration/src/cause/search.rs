//! Minimum of a function of one variable.

/// Golden section, `(sqrt(5) - 1)/2`.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// Points of the first scan, which finds the valley.
const POINTS: u32 = 9;

/// Steps of the golden section within the valley; each multiplies its width by 0.618.
const STEPS: u32 = 14;

/// Returns the argument between `from` and `to` at which `cost` is least, within a thousandth of the interval; `None`
/// if `cost` is nowhere finite.
pub(super) fn least(from: f64, to: f64, cost: impl Fn(f64) -> f64) -> Option<f64> {
    let at = |point: u32| from + (to - from) * f64::from(point) / f64::from(POINTS - 1);
    let scanned = (0..POINTS).map(|point| (cost(at(point)), point));
    let scanned = scanned.filter(|(cost, _)| cost.is_finite());
    let (_, best) = scanned.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(POINTS - 1)));
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut left, mut right] = inner(low, high);
    let (mut at_left, mut at_right) = (cost(left), cost(right));
    for _ in 0..STEPS {
        if at_left <= at_right || at_right.is_nan() {
            (high, right, at_right) = (right, left, at_left);
            left = inner(low, high)[0];
            at_left = cost(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = inner(low, high)[1];
            at_right = cost(right);
        }
    }
    Some(if at_left <= at_right { left } else { right })
}

#[cfg(test)]
mod tests {
    use super::least;

    #[test]
    fn the_least_value_is_found_at_the_side_and_between() {
        for (wanted, from, to) in [(0.3, 0.0, 1.0), (2.0, -1.0, 2.0), (-1.0, -1.0, 2.0)] {
            let found = least(from, to, |x| (x - wanted).powi(2)).unwrap();
            assert!((found - wanted).abs() < 3e-3, "{found} {wanted}");
        }
        assert_eq!(least(0.0, 1.0, |_| f64::NAN), None);
        let beside_nan = least(0.0, 1.0, |x| if x > 0.7 { f64::NAN } else { -x });
        assert!((beside_nan.unwrap() - 0.7).abs() < 3e-3);
    }
}
