//! Quadratic B-splines through values at the middles of equal cells.

/// End condition of a spline: the coefficient beyond the end is `factor` times the one before it, plus `offset`.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    factor: f64,
    offset: f64,
}

impl End {
    /// The coefficient beyond the end is `factor` times the one before it.
    pub(super) fn multiple(factor: f64) -> Self {
        Self {
            factor,
            offset: 0.0,
        }
    }

    /// The spline has this value at the end.
    pub(super) fn value(value: f64) -> Self {
        Self {
            factor: -1.0,
            offset: 2.0 * value,
        }
    }

    /// The coefficient beyond the end is `offset`.
    pub(super) fn coefficient(offset: f64) -> Self {
        Self {
            factor: 0.0,
            offset,
        }
    }
}

/// Coefficients of the spline through `values` at the middles of the cells, including one beyond each end.
pub(super) fn fit(values: &[f64], [first, last]: [End; 2]) -> Vec<f64> {
    // At the middle of a cell the three splines have the values 1/8, 6/8 and 1/8, so the system is tridiagonal.
    let count = values.len();
    let mut pivots = Vec::with_capacity(count);
    let mut rights = Vec::with_capacity(count);
    for (index, value) in values.iter().enumerate() {
        let (mut pivot, mut right) = (6.0, 8.0 * value);
        if index == 0 {
            pivot += first.factor;
            right -= first.offset;
        } else {
            pivot -= 1.0 / pivots[index - 1];
            right -= rights[index - 1] / pivots[index - 1];
        }
        if index + 1 == count {
            pivot += last.factor;
            right -= last.offset;
        }
        pivots.push(pivot);
        rights.push(right);
    }
    let mut coefficients = vec![0.0; count + 2];
    let mut after = 0.0;
    for index in (0..count).rev() {
        after = (rights[index] - after) / pivots[index];
        coefficients[index + 1] = after;
    }
    coefficients[0] = first.factor * coefficients[1] + first.offset;
    coefficients[count + 1] = last.factor * coefficients[count] + last.offset;
    coefficients
}
