//! Rolling radius difference and equivalent conicity (EN 15302).

use crate::contact::Pair;

/// Lateral distance between the contact points for a gauge of 1435 mm (EN 15302), m.
pub const CONTACT_DISTANCE_M: f64 = 1.5;

/// Errors in the samples of a rolling radius difference.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RollingRadiusError {
    /// There are fewer than two samples, or the numbers of shifts and differences differ.
    #[error(
        "samples: {shifts} shifts and {differences} differences, allowed: two or more, the same number of each"
    )]
    Length {
        /// Number of shifts.
        shifts: usize,
        /// Number of differences.
        differences: usize,
    },
    /// A sample is not finite, or its shift is not evenly spaced.
    #[error(
        "sample {index}: shift {lateral_m} m, difference {difference_m} m; allowed: finite numbers with evenly \
         rising shifts"
    )]
    Sample {
        /// Index of the sample, from 0.
        index: usize,
        /// Its lateral shift, m.
        lateral_m: f64,
        /// Its difference, m.
        difference_m: f64,
    },
}

/// Rolling radius difference as a function of the wheelset's lateral shift, linear between evenly spaced samples.
///
/// ```
/// use dashpot_rail::indices::RollingRadiusDifference;
/// // Wheels with cones of 0.05: the difference is 2 * 0.05 * shift.
/// let cone = RollingRadiusDifference::from_fn(10e-3, 400, |lateral_m| 0.1 * lateral_m)?;
/// let conicity = cone.equivalent_conicity(3e-3, 0.46);
/// assert!((conicity.unwrap_or(0.0) - 0.05).abs() < 1e-6);
/// # Ok::<(), dashpot_rail::indices::RollingRadiusError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RollingRadiusDifference {
    lateral: Vec<f64>,
    difference: Vec<f64>,
    /// Integral of the difference from the first shift to each shift, m^2.
    integral: Vec<f64>,
}

impl RollingRadiusDifference {
    /// Returns the function through `difference_m` (right minus left rolling radius, m) at the evenly rising shifts
    /// `lateral_m` (at the top of the rails, positive to the right, m).
    ///
    /// # Errors
    /// Fewer than two samples, vectors of different lengths, a non-finite value, or shifts that do not rise evenly.
    pub fn new(lateral_m: Vec<f64>, difference_m: Vec<f64>) -> Result<Self, RollingRadiusError> {
        check(&lateral_m, &difference_m)?;
        let (lateral, difference) = (lateral_m, difference_m);
        let mut integral = vec![0.0];
        let mut sum = 0.0;
        for i in 1..lateral.len() {
            sum += 0.5 * (difference[i] + difference[i - 1]) * (lateral[i] - lateral[i - 1]);
            integral.push(sum);
        }
        Ok(Self {
            lateral,
            difference,
            integral,
        })
    }

    /// Samples the rigid wheelset of `pair` without yaw, at shifts from `-reach_m` to `reach_m` in `cells` cells.
    ///
    /// # Errors
    /// A `reach_m` that is not positive, or no cells.
    pub fn of(pair: &Pair, reach_m: f64, cells: usize) -> Result<Self, RollingRadiusError> {
        let mut scratch = Vec::new();
        Self::from_fn(reach_m, cells, |lateral_m| {
            pair.rigid_contact(lateral_m, 0.0, &mut scratch)
                .rolling_radius_difference_m()
        })
    }

    /// Samples a function of the shift (both in m) from `-reach_m` to `reach_m` in `cells` cells.
    ///
    /// # Errors
    /// A `reach_m` that is not positive, no cells, or a non-finite difference.
    pub fn from_fn(
        reach_m: f64,
        cells: usize,
        mut difference_m: impl FnMut(f64) -> f64,
    ) -> Result<Self, RollingRadiusError> {
        let lateral: Vec<f64> = (0..=cells)
            .map(|i| reach_m * (2.0 * i as f64 / cells as f64 - 1.0))
            .collect();
        let difference = lateral.iter().map(|&y| difference_m(y)).collect();
        Self::new(lateral, difference)
    }

    /// Returns the shifts of the samples, m.
    pub fn lateral_m(&self) -> &[f64] {
        &self.lateral
    }

    /// Returns the differences of the samples, right minus left rolling radius, m.
    pub fn difference_m(&self) -> &[f64] {
        &self.difference
    }

    /// Cell that contains `lateral`, and the position in it from 0 to 1, clamped to the ends.
    fn locate(&self, lateral: f64) -> (usize, f64) {
        let last = self.lateral.len() - 1;
        let step = (self.lateral[last] - self.lateral[0]) / last as f64;
        let x = ((lateral - self.lateral[0]) / step).clamp(0.0, last as f64);
        let i = (x as usize).min(last - 1);
        (i, x - i as f64)
    }

    /// Returns the difference at the shift `lateral_m`, m; beyond the ends, the difference at the nearest end.
    pub fn at(&self, lateral_m: f64) -> f64 {
        let (i, t) = self.locate(lateral_m);
        self.difference[i] + t * (self.difference[i + 1] - self.difference[i])
    }

    /// Returns the shift nearest to the centre at which the wheelset rolls straight, m; `None` if there is none.
    pub fn rolling_line_m(&self) -> Option<f64> {
        (0..self.lateral.len() - 1)
            .filter_map(|i| {
                let (d0, d1) = (self.difference[i], self.difference[i + 1]);
                let crosses = d0 <= 0.0 && d1 >= 0.0;
                let t = if d1 > d0 { -d0 / (d1 - d0) } else { 0.5 };
                crosses.then(|| self.lateral[i] + t * (self.lateral[i + 1] - self.lateral[i]))
            })
            .min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Returns the equivalent conicity, dimensionless, of a motion with turning points `2 amplitude_m` apart, for
    /// wheels of the nominal radius `radius_m`.
    ///
    /// The path of the free wheelset obeys `y'' = -difference / (e r)` (EN 15302). Its first integral gives the
    /// wavelength `L`, and the cone with the same wavelength has `tan g = 2 pi^2 e r / L^2`. Returns `None` if the path
    /// does not turn back within the samples, or if an argument is not positive.
    pub fn equivalent_conicity(&self, amplitude_m: f64, radius_m: f64) -> Option<f64> {
        if !(amplitude_m > 0.0 && radius_m > 0.0) {
            return None;
        }
        let centre = self.rolling_line_m()?;
        let (left, right) = self.turning_points(centre, 2.0 * amplitude_m)?;
        if ((right - left) / (2.0 * amplitude_m) - 1.0).abs() > 1e-6 {
            return None;
        }
        let wavelength = 2.0
            * (self.quarter_wave(centre, left) + self.quarter_wave(centre, right))
            * (CONTACT_DISTANCE_M * radius_m / 2.0).sqrt();
        let tau = std::f64::consts::TAU;
        Some(0.5 * CONTACT_DISTANCE_M * radius_m * (tau / wavelength).powi(2))
    }

    /// Finds the left and right turning points of the motion about `centre` whose distance is closest to `distance`, by
    /// bisection.
    fn turning_points(&self, centre: f64, distance: f64) -> Option<(f64, f64)> {
        let (mut low, mut high) = (0.0, centre - self.lateral[0]);
        let mut turning = None;
        for _ in 0..60 {
            let half = 0.5 * (low + high);
            let left = centre - half;
            match self.right_turning_point(centre, left) {
                Some(right) => {
                    turning = Some((left, right));
                    if right - left < distance {
                        low = half;
                    } else {
                        high = half;
                    }
                }
                None => high = half,
            }
        }
        turning
    }

    /// Finds the turning point to the right of `centre` of a motion that turns at `left`. The integral of the
    /// rolling radius difference from one turning point to the other is zero. `None` if the turning point is beyond the
    /// samples.
    fn right_turning_point(&self, centre: f64, left: f64) -> Option<f64> {
        let end = self.lateral[self.lateral.len() - 1];
        if self.integral(left, end) <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (centre, end);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.integral(left, middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(0.5 * (low + high))
    }

    /// Integral of the difference from `from` to `to`, m^2, exact for the piecewise linear function.
    fn integral(&self, from: f64, to: f64) -> f64 {
        let primitive = |lateral: f64| {
            let (i, t) = self.locate(lateral);
            let step = self.lateral[i + 1] - self.lateral[i];
            let (d0, d1) = (self.difference[i], self.difference[i + 1]);
            self.integral[i] + step * t * (d0 + 0.5 * t * (d1 - d0))
        };
        primitive(to) - primitive(from)
    }

    /// Integral of `dy / sqrt(integral(y, turn))` from `centre` to `turn`. The substitution
    /// `y = turn - (turn - centre) p^2` removes the singularity at the turning point.
    fn quarter_wave(&self, centre: f64, turn: f64) -> f64 {
        const POINTS: usize = 2000;
        let span = turn - centre;
        let weight = 2.0 * span.abs() / (POINTS * POINTS) as f64;
        (0..POINTS)
            .map(|i| i as f64 + 0.5)
            .map(|i| {
                let integral = self.integral(turn - span * (i / POINTS as f64).powi(2), turn);
                if integral > 0.0 {
                    weight * i / integral.sqrt()
                } else {
                    0.0
                }
            })
            .sum()
    }
}

/// Checks the samples of [`RollingRadiusDifference::new`].
fn check(lateral: &[f64], difference: &[f64]) -> Result<(), RollingRadiusError> {
    let (shifts, differences) = (lateral.len(), difference.len());
    if shifts < 2 || shifts != differences {
        return Err(RollingRadiusError::Length {
            shifts,
            differences,
        });
    }
    let step = (lateral[shifts - 1] - lateral[0]) / (shifts - 1) as f64;
    for (index, (&lateral_m, &difference_m)) in lateral.iter().zip(difference).enumerate() {
        let even = lateral[0] + step * index as f64;
        // The tolerance allows for rounding errors.
        let fits = step > 0.0 && (lateral_m - even).abs() <= 1e-6 * step;
        if !(fits && difference_m.is_finite()) {
            return Err(RollingRadiusError::Sample {
                index,
                lateral_m,
                difference_m,
            });
        }
    }
    Ok(())
}
