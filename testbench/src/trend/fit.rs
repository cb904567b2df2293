//! Straight line through readings with known standard deviations and an unknown scatter from recording to recording.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Confidence of all intervals.
pub const CONFIDENCE: f64 = 0.95;

/// Fewest readings of a line: one more than its coefficients, so that their scatter can be seen.
pub const MIN_POINTS: usize = 3;

/// Halvings of the interval that contains the scatter.
const HALVINGS: usize = 200;

/// A reading of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Abscissa: days or km.
    pub x: f64,
    /// Estimate.
    pub y: f64,
    /// Standard deviation of the estimate within its recording.
    pub sd: f64,
}

/// Weighted least-squares line `value + slope (x - centre)`, whose two coefficients are uncorrelated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Weighted mean of the abscissas.
    pub centre: f64,
    /// Ordinate at the centre.
    pub value: f64,
    /// Slope.
    pub slope: f64,
    /// Variance of `value`.
    pub value_variance: f64,
    /// Variance of `slope`.
    pub slope_variance: f64,
    /// Standard deviation between recordings, beyond the deviations of the readings.
    pub scatter: f64,
    /// Degrees of freedom.
    pub degrees: f64,
    /// Quantile of Student's distribution for [`CONFIDENCE`].
    pub quantile: f64,
}

/// A value and its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Interval {
    /// Estimate.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Returns the interval of half width `half` about `value`.
    pub fn around(value: f64, half: f64) -> Self {
        Self {
            value,
            low: value - half,
            high: value + half,
        }
    }

    /// Applies a monotone function; the ends stay in order.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let (low, high) = (f(self.low), f(self.high));
        Self {
            value: f(self.value),
            low: low.min(high),
            high: low.max(high),
        }
    }
}

/// Sums of a weighted regression.
struct Sums {
    weight: f64,
    centre: f64,
    value: f64,
    /// Weighted sum of squares of the abscissas about the centre.
    spread: f64,
    slope: f64,
}

impl Sums {
    fn new(points: &[Point], scatter_variance: f64) -> Self {
        let weight_of = |point: &Point| 1.0 / (point.sd * point.sd + scatter_variance);
        let weight: f64 = points.iter().map(weight_of).sum();
        let mean = |of: fn(&Point) -> f64| {
            let sum: f64 = points
                .iter()
                .map(|point| weight_of(point) * of(point))
                .sum();
            sum / weight
        };
        let (centre, value) = (mean(|point| point.x), mean(|point| point.y));
        let (mut spread, mut product) = (0.0, 0.0);
        for point in points {
            let from_centre = weight_of(point) * (point.x - centre);
            spread += from_centre * (point.x - centre);
            product += from_centre * (point.y - value);
        }
        Self {
            weight,
            centre,
            value,
            spread,
            slope: product / spread,
        }
    }

    /// Sum of the squared residuals, each over its variance.
    fn chi_square(&self, points: &[Point], scatter_variance: f64) -> f64 {
        let square = |point: &Point| {
            let residual = point.y - self.value - self.slope * (point.x - self.centre);
            residual * residual / (point.sd * point.sd + scatter_variance)
        };
        points.iter().map(square).sum()
    }
}

/// Returns the variance between recordings by the method of moments of Paule and Mandel (1982): with it, the sum of the
/// squared residuals over their variances equals the degrees of freedom. It is 0 if the readings scatter less than
/// their own deviations say.
fn scatter_variance(points: &[Point], degrees: f64) -> f64 {
    let excess = |variance: f64| Sums::new(points, variance).chi_square(points, variance) - degrees;
    if excess(0.0) <= 0.0 {
        return 0.0;
    }
    // The sum falls with the variance. With the variance of all residuals it is below the degrees of freedom soon.
    let mut high = points.iter().map(|point| point.sd * point.sd).sum::<f64>();
    for _ in 0..HALVINGS {
        if excess(high) <= 0.0 {
            break;
        }
        high *= 4.0;
    }
    let mut low = 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        match excess(middle) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

impl Line {
    /// Fits a line; `None` with fewer than [`MIN_POINTS`] readings, at fewer than two abscissas, or with a deviation
    /// that is not positive.
    pub fn fit(points: &[Point]) -> Option<Self> {
        let is_usable = |point: &Point| {
            point.x.is_finite() && point.y.is_finite() && point.sd.is_finite() && point.sd > 0.0
        };
        let first = points.first()?.x;
        let has_spread = points.iter().any(|point| point.x != first);
        if points.len() < MIN_POINTS || !has_spread || !points.iter().all(is_usable) {
            return None;
        }
        let degrees = (points.len() - 2) as f64;
        let variance = scatter_variance(points, degrees);
        let sums = Sums::new(points, variance);
        let student = StudentsT::new(0.0, 1.0, degrees).ok()?;
        Some(Self {
            centre: sums.centre,
            value: sums.value,
            slope: sums.slope,
            value_variance: 1.0 / sums.weight,
            slope_variance: 1.0 / sums.spread,
            scatter: variance.sqrt(),
            degrees,
            quantile: student.inverse_cdf(0.5 + 0.5 * CONFIDENCE),
        })
    }

    /// Returns the ordinate at `x` with the confidence interval of the line, without the scatter of a single reading.
    pub fn at(&self, x: f64) -> Interval {
        let from_centre = x - self.centre;
        let variance = self.value_variance + self.slope_variance * from_centre * from_centre;
        Interval::around(
            self.value + self.slope * from_centre,
            self.quantile * variance.sqrt(),
        )
    }

    /// Returns the slope with its confidence interval.
    pub fn rate(&self) -> Interval {
        Interval::around(self.slope, self.quantile * self.slope_variance.sqrt())
    }

    /// True if the confidence interval of the slope excludes zero.
    pub fn has_changed(&self) -> bool {
        self.slope.abs() > self.quantile * self.slope_variance.sqrt()
    }

    /// Probability of a slope at least as large, in either direction, if nothing changed.
    pub fn p_value(&self) -> f64 {
        let deviations = self.slope.abs() / self.slope_variance.sqrt();
        match StudentsT::new(0.0, 1.0, self.degrees) {
            Ok(student) => 2.0 * student.sf(deviations),
            Err(_) => f64::NAN,
        }
    }
}
