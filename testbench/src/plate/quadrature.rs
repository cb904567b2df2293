//! Gauss-Legendre quadrature.

/// Positive points and weights of the eight-point rule on -1 to 1; the other four points are their negatives
/// (Abramowitz and Stegun, table 25.4).
const POSITIVE_POINTS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Returns points from `start` to `end` and their weights; the rule is exact for polynomials up to the 15th degree.
pub(super) fn points(start: f64, end: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
    POSITIVE_POINTS
        .into_iter()
        .flat_map(move |(at, weight)| [-at, at].map(|at| (middle + half * at, half * weight)))
}

/// Integrates `function` from `start` to `end`.
pub(super) fn integral(start: f64, end: f64, function: impl Fn(f64) -> f64) -> f64 {
    points(start, end)
        .map(|(at, weight)| weight * function(at))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::integral;

    #[test]
    fn the_rule_is_exact_for_the_fifteenth_power() {
        let found = integral(0.0, 2.0, |x| 16.0 * x.powi(15));
        assert!((found / 65536.0 - 1.0).abs() < 1e-14, "{found}");
    }
}
