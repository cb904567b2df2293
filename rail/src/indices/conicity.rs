//! Rolling radius difference and equivalent conicity (EN 15302).

use crate::contact::pair::Pair;

/// Lateral distance of the contact points, by EN 15302 for 1435 mm gauge, m.
pub const CONTACT_DISTANCE: f64 = 1.5;

/// Rolling radius difference over lateral shift, linear between evenly spaced points.
#[derive(Debug, Clone)]
pub struct RollingRadius {
    /// Lateral shifts at the rails' top, rising and even, m.
    pub lateral: Vec<f64>,
    /// Right less left rolling radius, m.
    pub difference: Vec<f64>,
    /// Integral of the difference from the first shift to each, m^2.
    potential: Vec<f64>,
}

impl RollingRadius {
    /// The broken line through `difference` at the even, rising shifts `lateral`, two or more.
    pub fn new(lateral: Vec<f64>, difference: Vec<f64>) -> Self {
        assert!(lateral.len() >= 2 && lateral.len() == difference.len());
        let mut potential = vec![0.0];
        let mut sum = 0.0;
        for i in 1..lateral.len() {
            sum += 0.5 * (difference[i] + difference[i - 1]) * (lateral[i] - lateral[i - 1]);
            potential.push(sum);
        }
        Self {
            lateral,
            difference,
            potential,
        }
    }

    /// The rigid wheelset of `pair` between `-reach` and `reach`, `steps` cells.
    pub fn of(pair: &Pair, reach: f64, steps: usize) -> Self {
        let mut room = Vec::new();
        Self::from_fn(reach, steps, |y| {
            pair.rigid(y, 0.0, &mut room).rolling_radius_difference()
        })
    }

    /// Any function of the shift.
    pub fn from_fn(reach: f64, steps: usize, mut difference: impl FnMut(f64) -> f64) -> Self {
        let lateral: Vec<f64> = (0..=steps)
            .map(|i| reach * (2.0 * i as f64 / steps as f64 - 1.0))
            .collect();
        let difference = lateral.iter().map(|&y| difference(y)).collect();
        Self::new(lateral, difference)
    }

    /// Cell of `lateral` and the share within it, held at the ends.
    fn locate(&self, lateral: f64) -> (usize, f64) {
        let last = self.lateral.len() - 1;
        let step = (self.lateral[last] - self.lateral[0]) / last as f64;
        let x = ((lateral - self.lateral[0]) / step).clamp(0.0, last as f64);
        let i = (x as usize).min(last - 1);
        (i, x - i as f64)
    }

    /// Difference at `lateral`, held at the ends, m.
    pub fn at(&self, lateral: f64) -> f64 {
        let (i, share) = self.locate(lateral);
        self.difference[i] + share * (self.difference[i + 1] - self.difference[i])
    }

    /// Shift at which the wheelset rolls straight, nearest to the middle, m; none when there is none.
    pub fn rolling_line(&self) -> Option<f64> {
        (0..self.lateral.len() - 1)
            .filter_map(|i| {
                let (d0, d1) = (self.difference[i], self.difference[i + 1]);
                let crosses = d0 <= 0.0 && d1 >= 0.0;
                let share = if d1 > d0 { -d0 / (d1 - d0) } else { 0.5 };
                crosses.then(|| self.lateral[i] + share * (self.lateral[i + 1] - self.lateral[i]))
            })
            .min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Equivalent conicity of the motion between two turning points `2 amplitude` apart.
    ///
    /// The free wheelset's path obeys `y'' = -difference / (e r)` (EN 15302); its first integral gives the
    /// wavelength `L`, and the cone with the same one has `tan g = 2 pi^2 e r / L^2`.
    /// None when the path does not turn back within the function's reach.
    pub fn conicity(&self, amplitude: f64, radius: f64) -> Option<f64> {
        let centre = self.rolling_line()?;
        // The other turning point: equal potential on both sides, found for the left end by bisection.
        let reach = |left: f64| -> Option<f64> {
            let end = self.lateral[self.lateral.len() - 1];
            let rest = |right: f64| self.integral(left, right);
            if rest(end) <= 0.0 {
                return None;
            }
            let (mut low, mut high) = (centre, end);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if rest(middle) > 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            Some(0.5 * (low + high))
        };
        let (mut low, mut high) = (0.0, centre - self.lateral[0]);
        let mut turning = None;
        for _ in 0..60 {
            let half = 0.5 * (low + high);
            match reach(centre - half) {
                Some(right) if right - (centre - half) < 2.0 * amplitude => {
                    low = half;
                    turning = Some((centre - half, right));
                }
                Some(right) => {
                    high = half;
                    turning = Some((centre - half, right));
                }
                None => high = half,
            }
        }
        let (left, right) = turning?;
        if ((right - left) / (2.0 * amplitude) - 1.0).abs() > 1e-6 {
            return None;
        }
        let wavelength = 2.0
            * (self.quarter(centre, left) + self.quarter(centre, right))
            * (CONTACT_DISTANCE * radius / 2.0).sqrt();
        let tau = std::f64::consts::TAU;
        Some(0.5 * CONTACT_DISTANCE * radius * (tau / wavelength).powi(2))
    }

    /// Integral of the difference from `from` to `to`, exact for the broken line.
    fn integral(&self, from: f64, to: f64) -> f64 {
        let primitive = |lateral: f64| {
            let (i, share) = self.locate(lateral);
            let step = self.lateral[i + 1] - self.lateral[i];
            let (d0, d1) = (self.difference[i], self.difference[i + 1]);
            self.potential[i] + step * share * (d0 + 0.5 * share * (d1 - d0))
        };
        primitive(to) - primitive(from)
    }

    /// Integral of `dy / sqrt(potential(turn) - potential(y))` from `centre` to `turn`;
    /// `y = turn - (turn - centre) p^2` removes the pole at the turning point.
    fn quarter(&self, centre: f64, turn: f64) -> f64 {
        const POINTS: usize = 2000;
        let span = turn - centre;
        let each = 2.0 * span.abs() / (POINTS * POINTS) as f64;
        (0..POINTS)
            .map(|i| i as f64 + 0.5)
            .map(|i| {
                let height = self.integral(turn - span * (i / POINTS as f64).powi(2), turn);
                if height > 0.0 {
                    each * i / height.sqrt()
                } else {
                    0.0
                }
            })
            .sum()
    }
}
