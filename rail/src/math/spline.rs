//! Natural cubic splines, interpolating or smoothing.

/// A natural cubic spline through, or near, given values.
#[derive(Debug, Clone)]
pub struct Spline {
    knots: Vec<f64>,
    values: Vec<f64>,
    second_derivatives: Vec<f64>,
}

impl Spline {
    /// Fits the natural spline that minimises `integral (f - v)^2 + lambda integral f''^2` (Reinsch 1967).
    ///
    /// The weight of each value is half the distance between its neighbours; `lambda = 0` interpolates. The amplitude
    /// of waves of length `L` along the knots is multiplied by `1 / (1 + lambda (2 pi / L)^4)`. The caller ensures that
    /// there are three or more `knots` and that they rise strictly.
    pub fn fit(knots: &[f64], values: &[f64], lambda: f64) -> Self {
        let n = knots.len();
        assert!(n >= 3 && values.len() == n, "a spline needs three knots");
        let h: Vec<f64> = knots.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let weight = |i: usize| {
            let before = if i > 0 { h[i - 1] } else { 0.0 };
            let after = if i < n - 1 { h[i] } else { 0.0 };
            0.5 * (before + after)
        };
        // Column j of Q, the second difference at knot j + 1.
        let column = |j: usize| [1.0 / h[j], -(1.0 / h[j] + 1.0 / h[j + 1]), 1.0 / h[j + 1]];
        let m = n - 2;
        let (mut diagonal, mut first, mut second) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
        let mut right_hand_side = vec![0.0; m];
        for j in 0..m {
            let q = column(j);
            let product = |other: [f64; 3], shift: usize| -> f64 {
                (shift..3)
                    .map(|k| q[k] * other[k - shift] / weight(j + k))
                    .sum()
            };
            diagonal[j] = (h[j] + h[j + 1]) / 3.0 + lambda * product(q, 0);
            if j + 1 < m {
                first[j] = h[j + 1] / 6.0 + lambda * product(column(j + 1), 1);
            }
            if j + 2 < m {
                second[j] = lambda * product(column(j + 2), 2);
            }
            right_hand_side[j] = (0..3).map(|k| q[k] * values[j + k]).sum();
        }
        let inner = solve_pentadiagonal(diagonal, first, second, right_hand_side);
        let mut second_derivatives = vec![0.0; n];
        second_derivatives[1..=m].copy_from_slice(&inner);
        let mut smoothed = values.to_vec();
        for (j, gamma) in inner.iter().enumerate() {
            for (k, q) in column(j).iter().enumerate() {
                smoothed[j + k] -= lambda * q * gamma / weight(j + k);
            }
        }
        Self {
            knots: knots.to_vec(),
            values: smoothed,
            second_derivatives,
        }
    }

    /// Returns `[value, first derivative, second derivative]` at `t`; beyond the ends the outermost cubic is
    /// extrapolated.
    pub fn at(&self, t: f64) -> [f64; 3] {
        let last = self.knots.len() - 2;
        let i = self
            .knots
            .partition_point(|&knot| knot <= t)
            .saturating_sub(1)
            .min(last);
        let h = self.knots[i + 1] - self.knots[i];
        let (right, left) = ((t - self.knots[i]) / h, (self.knots[i + 1] - t) / h);
        let (m0, m1) = (self.second_derivatives[i], self.second_derivatives[i + 1]);
        let value = left * self.values[i]
            + right * self.values[i + 1]
            + h * h / 6.0 * ((left.powi(3) - left) * m0 + (right.powi(3) - right) * m1);
        let slope = (self.values[i + 1] - self.values[i]) / h
            + h / 6.0 * ((3.0 * right * right - 1.0) * m1 - (3.0 * left * left - 1.0) * m0);
        [value, slope, left * m0 + right * m1]
    }
}

/// Solves a symmetric positive definite system with diagonal `d`, first and second upper bands `e` and `f`, and
/// right-hand side `b`.
fn solve_pentadiagonal(
    mut d: Vec<f64>,
    mut e: Vec<f64>,
    mut f: Vec<f64>,
    mut b: Vec<f64>,
) -> Vec<f64> {
    let n = d.len();
    for i in 0..n {
        let (e_i, f_i) = (e[i] / d[i], f[i] / d[i]);
        if i + 1 < n {
            d[i + 1] -= e_i * e[i];
            e[i + 1] -= e_i * f[i];
            b[i + 1] -= e_i * b[i];
        }
        if i + 2 < n {
            d[i + 2] -= f_i * f[i];
            b[i + 2] -= f_i * b[i];
        }
        (e[i], f[i]) = (e_i, f_i);
    }
    for i in (0..n).rev() {
        b[i] /= d[i];
        if i + 1 < n {
            b[i] -= e[i] * b[i + 1];
        }
        if i + 2 < n {
            b[i] -= f[i] * b[i + 2];
        }
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_is_interpolated_and_smoothed_by_the_documented_gain() {
        let length = 2.0_f64;
        let k = std::f64::consts::TAU / length;
        let knots: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.05).collect();
        let values: Vec<f64> = knots.iter().map(|t| (k * t).sin()).collect();
        let exact = Spline::fit(&knots, &values, 0.0);
        let [value, slope, second] = exact.at(10.012);
        assert!((value - (k * 10.012).sin()).abs() < 2e-6);
        assert!((slope / k - (k * 10.012).cos()).abs() < 1e-4);
        assert!((second / (k * k) + (k * 10.012).sin()).abs() < 3e-3);
        for lambda in [0.001, 0.01, 0.1] {
            let smooth = Spline::fit(&knots, &values, lambda);
            let gain = smooth.at(10.5)[0] / (k * 10.5).sin();
            let formula = 1.0 / (1.0 + lambda * k.powi(4));
            assert!((gain - formula).abs() < 1e-3, "{gain} {formula}");
        }
    }
}
