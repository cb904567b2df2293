//! The imaginary axis in intervals so short that nothing of the loop is missed.

use nalgebra::Complex;

use super::crossing::Crossing;
use super::error::PlanError;
use super::frequency_response::ClosedWithoutDelay;
use super::piece::{Cubic, Jet, can_cross, phase_change};

type C64 = Complex<f64>;

/// Ratio of neighbouring frequencies before refinement.
const RATIO: f64 = 1.1;
/// Longest interval, part of the distance to the nearest pole of `T`. The error of a cubic is then below
/// `(1/8)^4` of what a pole contributes.
const PER_DISTANCE: f64 = 0.25;
/// First frequency, part of the distance of the nearest pole from zero: `T` is constant below to this part.
const FIRST: f64 = 1e-4;
/// Shortest interval, part of the same distance and of the root of the rounding: where the loop touches 1, rounding
/// hides as many as the inverse.
const MIN_PER_DISTANCE: f64 = 1e-2;
/// Maximum samples. A locomotive takes some thousands.
const MAX_SAMPLES: usize = 200_000;
/// Largest part of `|T F|` that remains at the last frequency, and factor by which `|F|` may exceed its samples.
const LAST: f64 = 0.25;
const BETWEEN: f64 = 2.0;
/// Ratio of the highest frequency at which `F` is checked to the last of the sweep.
const BEYOND: f64 = 1e3;
/// Relative step of the derivative of `F`, and the change of `F` within it that is too much, part of the loop.
const STEP: f64 = 1e-6;
const MAX_CHANGE: f64 = 0.1;
/// Largest phase of the loop (rad) at the first frequency, beside that of a real number, and the smallest relative
/// difference of `|u|` and `|v|` there.
const MAX_FIRST_PHASE: f64 = 0.1;
const MIN_FIRST_DIFFERENCE: f64 = 1e-3;

/// A sample of `u = T F` and `v = 1 - T`, with slopes per rad/s.
#[derive(Clone, Copy)]
struct Sample {
    omega: f64,
    u: Jet,
    v: Jet,
    /// `|T| |dF/domega|`, and the same of `|F|` alone.
    of_factor: f64,
    of_magnitude: f64,
}

/// What the sweep of a loop found.
pub(super) struct Swept {
    /// Phase change of `1 - T + T F` from zero to infinite frequency, divided by `pi`.
    pub half_turns: f64,
    /// Frequencies at which `|L F|` is 1.
    pub crossings: Vec<Crossing>,
    /// Frequencies at which `|L F|` is 1 to within rounding, with a crossing or without.
    pub touches: Vec<Crossing>,
}

enum Verdict {
    Split,
    /// `F` changes its phase too much in the interval.
    Winds,
    /// The phase change is known; it is undecided whether `|u|` equals `|v|`.
    Touches(f64),
    Resolved {
        phase: f64,
        can_cross: bool,
    },
}

/// A loop with a factor `F`.
pub(super) struct Loop<'a, F> {
    pub closed: &'a ClosedWithoutDelay,
    pub factor: F,
}

impl<F: Fn(C64) -> C64> Loop<'_, F> {
    fn factor(&self, omega: f64) -> Result<C64, PlanError> {
        let value = (self.factor)(C64::new(0.0, omega));
        if value.re.is_finite() && value.im.is_finite() {
            Ok(value)
        } else {
            let frequency_hz = omega / std::f64::consts::TAU;
            Err(PlanError::LoopFactor { frequency_hz })
        }
    }

    fn sample(&self, omega: f64) -> Result<Sample, PlanError> {
        let (t, t_slope) = self.closed.response(omega);
        let step = STEP * omega;
        let [before, f, after] = [
            self.factor(omega - step)?,
            self.factor(omega)?,
            self.factor(omega + step)?,
        ];
        let f_slope = (after - before) / (2.0 * step);
        let (u, v) = (t * f, C64::from(1.0) - t);
        let scale = u.norm().max(MAX_CHANGE * v.norm());
        if t.norm() * (after - before).norm() > MAX_CHANGE * scale {
            return Err(varies(omega));
        }
        let magnitude_slope = (after.norm() - before.norm()) / (2.0 * step);
        Ok(Sample {
            omega,
            u: Jet {
                value: u,
                slope: t_slope * f + t * f_slope,
            },
            v: Jet {
                value: v,
                slope: -t_slope,
            },
            of_factor: t.norm() * f_slope.norm(),
            of_magnitude: t.norm() * magnitude_slope.abs(),
        })
    }

    /// `|L F|^2 - 1` up to a positive factor, and the crossing if it is zero.
    pub fn excess(&self, omega: f64) -> Result<(f64, Crossing), PlanError> {
        let (t, _) = self.closed.response(omega);
        let (u, v) = (t * self.factor(omega)?, C64::from(1.0) - t);
        Ok((u.norm_sqr() - v.norm_sqr(), Crossing::new(omega, u, v)))
    }

    /// Sweeps the axis from zero to infinite frequency.
    ///
    /// No crossing and no turn is missed, for three reasons. `T` is rational, its poles are known, and an interval is
    /// short against the distance to the nearest of them, so that no resonance hides between samples. `F` is sampled
    /// with its slope at frequencies at most 5 % apart; it is required to vary by less than a factor of two between
    /// them. Within an interval both are cubics with a bound of their error, taken from the sample in the middle, and
    /// the interval counts as resolved only if these bounds exclude a zero, or leave one crossing at most. Beyond the
    /// last frequency `|T|` has a bound.
    ///
    /// # Errors
    /// `F` is not finite or grows too fast, or an interval is not resolved.
    pub fn sweep(&self) -> Result<Swept, PlanError> {
        let poles = self.closed.poles().iter();
        let nearest = poles.map(|pole| pole.norm()).fold(f64::INFINITY, f64::min);
        let first = FIRST * nearest;
        let last = self.last(first)?;
        let mut swept = Swept {
            half_turns: 0.0,
            crossings: Vec::new(),
            touches: Vec::new(),
        };
        let mut start = self.sample(first)?;
        let mut phase = first_phase(&start)?;
        let mut samples = 1;
        // Intervals to the right of `start` that are not yet examined, the next of them last.
        let mut ends: Vec<Sample> = Vec::new();
        while start.omega < last {
            let end = match ends.last() {
                Some(end) => *end,
                None => {
                    samples += 1;
                    let end = self.sample(start.omega * RATIO)?;
                    ends.push(end);
                    end
                }
            };
            if samples >= MAX_SAMPLES {
                let frequency_hz = start.omega / std::f64::consts::TAU;
                return Err(PlanError::TooFine {
                    samples,
                    frequency_hz,
                });
            }
            samples += 1;
            let middle = self.sample(0.5 * (start.omega + end.omega))?;
            match self.examine(&start, &middle, &end) {
                Verdict::Resolved {
                    phase: change,
                    can_cross,
                } => {
                    phase += change;
                    if can_cross && let Some(found) = self.crossing(&start, &end)? {
                        swept.crossings.push(found);
                    }
                }
                _ if end.omega - start.omega > self.min_width(middle.omega) => {
                    ends.push(middle);
                    continue;
                }
                Verdict::Touches(change) => {
                    phase += change;
                    let (u, v) = (middle.u.value, middle.v.value);
                    swept.touches.push(Crossing::new(middle.omega, u, v));
                }
                Verdict::Winds => return Err(varies(middle.omega)),
                Verdict::Split => {
                    let frequency_hz = middle.omega / std::f64::consts::TAU;
                    return Err(PlanError::OnLimit { frequency_hz });
                }
            }
            start = end;
            ends.pop();
        }
        // At infinite frequency the loop is 1, and nothing turns about zero on the way there.
        phase -= (start.u.value + start.v.value).arg();
        swept.half_turns = phase / std::f64::consts::PI;
        Ok(swept)
    }

    /// Frequency above which `|T F|` is small, rad/s.
    fn last(&self, first: f64) -> Result<f64, PlanError> {
        let mut last = (2.0 * self.closed.norm()).max(first);
        loop {
            let (mut omega, mut largest) = (last, None);
            while omega < BEYOND * last {
                // Without the factor `T` must be small there too.
                let magnitude = self.factor(omega)?.norm().max(1.0);
                let allowed = LAST / (BETWEEN * self.closed.bound(omega));
                if magnitude >= allowed {
                    largest = Some((omega, magnitude, allowed));
                }
                omega *= RATIO;
            }
            match largest {
                None => return Ok(last),
                // A factor that is bounded leaves the bound of `T` behind soon.
                Some((omega, ..)) if omega < BEYOND * self.closed.norm() * 1e3 => {
                    last = omega * RATIO;
                }
                Some((omega, magnitude, allowed)) => {
                    return Err(PlanError::LoopFactorGrows {
                        frequency_hz: omega / std::f64::consts::TAU,
                        magnitude,
                        allowed,
                    });
                }
            }
        }
    }

    /// Shortest interval at this frequency, rad/s.
    fn min_width(&self, omega: f64) -> f64 {
        let distance = self.closed.distance(omega);
        MIN_PER_DISTANCE * self.closed.rounding(distance).sqrt() * distance
    }

    /// Decides about the interval from `start` to `end`.
    fn examine(&self, start: &Sample, middle: &Sample, end: &Sample) -> Verdict {
        let width = end.omega - start.omega;
        let distance = self.closed.distance(middle.omega);
        let rounding = self.closed.rounding(distance);
        if width > PER_DISTANCE * distance {
            return Verdict::Split;
        }
        let all = [start, middle, end];
        let max = |of: fn(&Sample) -> f64| all.iter().map(|s| of(s)).fold(0.0, f64::max);
        let v = Cubic::new(width, [start.v, end.v], middle.v.value, rounding);
        let magnitude = max(|s| s.u.value.norm());
        let bound = BETWEEN * magnitude + width * max(|s| s.of_magnitude);
        let (v_min, direction) = v.min();
        if bound < v_min {
            // The loop stays in the half plane of `v`, whatever the phase of `F`.
            let phase = |s: &Sample| ((s.u.value + s.v.value) * direction.conj()).arg();
            return Verdict::Resolved {
                phase: phase(end) - phase(start),
                can_cross: false,
            };
        }
        // The phase of `F` turns by less than a radian between samples, so none of its turns is missed.
        let turns = width * max(|s| s.of_factor);
        if turns > magnitude.max(MAX_CHANGE * v.max()) {
            return Verdict::Winds;
        }
        let u = Cubic::new(width, [start.u, end.u], middle.u.value, rounding);
        match (phase_change(&u, &v), can_cross(&u, &v)) {
            (Some(phase), Some(can_cross)) => Verdict::Resolved { phase, can_cross },
            (Some(phase), None) => Verdict::Touches(phase),
            (None, _) => Verdict::Split,
        }
    }

    /// The crossing between two samples, between which the excess is monotonic; `None` if it has the same sign at both.
    fn crossing(&self, start: &Sample, end: &Sample) -> Result<Option<Crossing>, PlanError> {
        let is_above = |s: &Sample| s.u.value.norm_sqr() >= s.v.value.norm_sqr();
        if is_above(start) == is_above(end) {
            return Ok(None);
        }
        Crossing::between(start.omega, end.omega, |omega| self.excess(omega)).map(Some)
    }
}

fn varies(omega: f64) -> PlanError {
    let frequency_hz = omega / std::f64::consts::TAU;
    PlanError::LoopFactorVaries { frequency_hz }
}

/// Phase of the loop at the first frequency beyond that at zero, where it is real.
fn first_phase(sample: &Sample) -> Result<f64, PlanError> {
    let sum = sample.u.value + sample.v.value;
    let turned = if sum.re < 0.0 { -sum } else { sum };
    let phase = turned.arg();
    let [u, v] = [sample.u.value.norm(), sample.v.value.norm()];
    if phase.abs() > MAX_FIRST_PHASE || (u - v).abs() < MIN_FIRST_DIFFERENCE * v.max(u) {
        let frequency_hz = sample.omega / std::f64::consts::TAU;
        return Err(PlanError::Slow { frequency_hz });
    }
    Ok(phase)
}
