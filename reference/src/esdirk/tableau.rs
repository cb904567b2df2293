//! Coefficients of the method ESDIRK 3/4 (Jørgensen, Kristensen, Thomsen: A Family of ESDIRK Integration Methods,
//! arXiv:1803.01613): four stages, the first explicit, order 3, L-stable, stiffly accurate, with an embedded method
//! of order 4.

/// Number of stages.
pub(super) const STAGES: usize = 4;

/// Order of the solution from which the next step starts.
pub(super) const ORDER: i32 = 3;

/// Diagonal coefficient of the implicit stages: a root of `6 x^3 - 18 x^2 + 9 x - 1`.
pub(super) const GAMMA: f64 = 0.435_866_521_508_459;

/// Coefficients below the diagonal, by stage. The last stage is the end of the step.
pub(super) const COEFFICIENTS: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 3],
    [GAMMA, 0.0, 0.0],
    [0.140_737_774_724_706_2, -0.108_365_551_381_320_8, 0.0],
    [
        0.102_399_400_619_911,
        -0.376_878_452_255_556_1,
        0.838_612_530_127_186_1,
    ],
];

/// Times of the stages, as fractions of the step.
pub(super) const TIMES: [f64; STAGES] = [0.0, 2.0 * GAMMA, 0.468_238_744_851_844_4, 1.0];

/// Weights of the stages in the error estimate: the solution minus the solution of the embedded method.
pub(super) const ERROR_WEIGHTS: [f64; STAGES] = [
    -0.054_625_497_240_413_94,
    -0.494_208_893_625_994_96,
    0.221_934_499_735_064_66,
    0.326_899_891_131_344_27,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// All coefficients, including the diagonal.
    fn whole() -> [[f64; STAGES]; STAGES] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i, j) {
                (0, _) => 0.0,
                _ if i == j => GAMMA,
                _ if j < i => COEFFICIENTS[i][j],
                _ => 0.0,
            })
        })
    }

    fn sum(weights: &[f64; STAGES], term: impl Fn(usize) -> f64) -> f64 {
        (0..STAGES).map(|stage| weights[stage] * term(stage)).sum()
    }

    fn assert_close(actual: f64, expected: f64) {
        assert!((actual - expected).abs() < 1e-13, "{actual} {expected}");
    }

    #[test]
    fn stages_are_consistent_and_of_order_two() {
        let a = whole();
        for (row, time) in a.iter().zip(TIMES) {
            assert_close(row.iter().sum(), time);
        }
        for stage in 1..STAGES {
            assert_close(sum(&a[stage], |j| TIMES[j]), 0.5 * TIMES[stage].powi(2));
        }
        assert_close(
            6.0 * GAMMA.powi(3) - 18.0 * GAMMA.powi(2) + 9.0 * GAMMA,
            1.0,
        );
    }

    /// Order conditions by rooted trees: up to order 3 for the solution, up to order 4 for the embedded one.
    #[test]
    fn order_conditions_hold() {
        let a = whole();
        let b = a[STAGES - 1];
        let embedded = std::array::from_fn(|stage| b[stage] - ERROR_WEIGHTS[stage]);
        let inner = |power: i32| move |i: usize| sum(&whole()[i], |j| TIMES[j].powi(power));
        for weights in [&b, &embedded] {
            assert_close(sum(weights, |_| 1.0), 1.0);
            assert_close(sum(weights, |i| TIMES[i]), 1.0 / 2.0);
            assert_close(sum(weights, |i| TIMES[i].powi(2)), 1.0 / 3.0);
            assert_close(sum(weights, inner(1)), 1.0 / 6.0);
        }
        assert_close(sum(&embedded, |i| TIMES[i].powi(3)), 1.0 / 4.0);
        assert_close(sum(&embedded, |i| TIMES[i] * inner(1)(i)), 1.0 / 8.0);
        assert_close(sum(&embedded, inner(2)), 1.0 / 12.0);
        assert_close(sum(&embedded, |i| sum(&a[i], inner(1))), 1.0 / 24.0);
    }
}
