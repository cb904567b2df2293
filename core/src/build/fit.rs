//! The cubic through four samples.

/// Returns the coefficients of 1, z, z^2, z^3 of the cubic through the values at four different z.
///
/// Uses Newton's divided differences. With `z[0] = 0` the constant coefficient is exactly the first value.
pub(super) fn cubic(z: [f64; 4], values: [f64; 4]) -> [f64; 4] {
    let mut differences = values;
    for order in 1..4 {
        for index in (order..4).rev() {
            differences[index] =
                (differences[index] - differences[index - 1]) / (z[index] - z[index - order]);
        }
    }
    // Horner's rule on polynomials: p <- p (z - z[index]) + difference.
    let mut p = [differences[3], 0.0, 0.0, 0.0];
    for index in (0..3).rev() {
        let node = z[index];
        p = [
            differences[index] - node * p[0],
            p[0] - node * p[1],
            p[1] - node * p[2],
            p[2] - node * p[3],
        ];
    }
    p
}

/// Evaluates a cubic at z.
pub(super) fn value([c0, c1, c2, c3]: [f64; 4], z: f64) -> f64 {
    ((c3 * z + c2) * z + c1) * z + c0
}

#[cfg(test)]
mod tests {
    use super::{cubic, value};

    #[test]
    fn a_cubic_comes_back() {
        let expected = [3.0, -2.0, 5.0, -7.0];
        let z = [0.0, 0.2, 0.7, 1.0];
        let found = cubic(z, z.map(|z| value(expected, z)));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12);
        }
        assert_eq!(found[0], 3.0);
    }
}
