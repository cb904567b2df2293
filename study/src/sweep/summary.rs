//! Means over seeds, with confidence intervals.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Mean with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Half width of the 95 % confidence interval; `None` for a single value.
    pub confidence: Option<f64>,
    /// Number of values.
    pub count: usize,
}

impl Estimate {
    /// Estimates the mean relative change (%) from each value in `from` to the value of the same seed in `to`. Pairs
    /// with a missing value are skipped.
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

    /// Estimates the mean of independent values: `mean +- t s / sqrt(n)` with the sample standard deviation `s` and
    /// Student's `t` for `n - 1` degrees of freedom. Returns `None` without values.
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
