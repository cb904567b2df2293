//! Means over seeds, and how sure they are.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A mean and half of its confidence interval of 95 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Half of the interval that has the true mean in 95 of 100 studies; none of a single value.
    pub confidence: Option<f64>,
    /// Values.
    pub count: usize,
}

impl Estimate {
    /// Of the relative changes, in percent, from each value to that of the same seed; pairs of which one is missing are left out.
    ///
    /// ```
    /// use dashpot_study::sweep::Estimate;
    /// let change = Estimate::of_change(&[Some(1.0), Some(2.0), None], &[Some(1.1), None, Some(9.0)]);
    /// assert!((change.unwrap().mean - 10.0).abs() < 1e-9);
    /// ```
    pub fn of_change(from: &[Option<f64>], to: &[Option<f64>]) -> Option<Self> {
        let pairs = from.iter().zip(to);
        let pairs = pairs.filter_map(|(from, to)| Some(((*from)?, (*to)?)));
        let changes: Vec<f64> = pairs.map(|(from, to)| 100.0 * (to / from - 1.0)).collect();
        Self::of(&changes)
    }

    /// Of independent values: `mean +- t s / sqrt(n)` with Student's `t` of `n - 1` degrees of freedom; none of no values.
    ///
    /// ```
    /// use dashpot_study::sweep::Estimate;
    /// let of_three = Estimate::of(&[1.0, 2.0, 3.0]).unwrap();
    /// assert_eq!(of_three.mean, 2.0);
    /// // 4.3027 / sqrt(3).
    /// assert!((of_three.confidence.unwrap() - 2.4841).abs() < 1e-4);
    /// ```
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        if count == 0 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / count as f64;
        let square = |value: &f64| (value - mean) * (value - mean);
        let variance = values.iter().map(square).sum::<f64>() / (count.max(2) - 1) as f64;
        let student = StudentsT::new(0.0, 1.0, (count.max(2) - 1) as f64).ok();
        let quantile = student.filter(|_| count > 1).map(|t| t.inverse_cdf(0.975));
        Some(Self {
            mean,
            confidence: quantile.map(|t| t * (variance / count as f64).sqrt()),
            count,
        })
    }
}
