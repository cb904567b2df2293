//! Random motions of the class for which docs/numerics.md promises an accuracy, and small changes of them, for the
//! search.

use std::f64::consts::TAU;

use dashpot_reference::probing::{Kind, Motion};

use crate::random_damper::Random;

/// Maximum distance of a motion from zero (m), as in the definition of the class.
const FARTHEST_M: f64 = 0.25;
/// Maximum ticks of a motion.
const MAX_TICKS: usize = 1200;
/// Ticks of a long rest.
const LONG_REST_TICKS: f64 = 2e4;

/// Form of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Constant speeds back and forth, each different.
    Saw,
    /// Constant speed, a sudden stop, rest, return.
    MoveAndStop,
    /// Segments of random speed and length.
    Pieces,
    /// Random motion up to 20 Hz.
    Ride,
    /// A sine.
    Harmonic,
    /// Speed that rises and falls linearly.
    Ramp,
}

/// A motion: its form, and its variable parameters.
#[derive(Clone, Debug)]
pub struct SearchedMotion {
    /// Form of the motion.
    pub form: Form,
    /// Forward and return speeds (m/s).
    speeds_m_per_s: [f64; 2],
    /// Ticks of a segment and of a rest.
    ticks: [f64; 2],
    /// Additional ticks of the first segment.
    shift: f64,
    /// Seed of the random numbers.
    seed: u64,
}

impl SearchedMotion {
    /// A random motion up to a speed (m/s).
    pub fn any(random: &mut Random, top_m_per_s: f64) -> Self {
        let form = match (8.0 * random.unit()) as u32 {
            0 | 1 => Form::Saw,
            2 | 3 => Form::MoveAndStop,
            4 => Form::Pieces,
            5 => Form::Ride,
            6 => Form::Harmonic,
            _ => Form::Ramp,
        };
        let speed = random.decades(1e-3 * top_m_per_s, top_m_per_s);
        let other = if random.happens(0.5) {
            speed
        } else {
            random.decades(1e-3 * top_m_per_s, top_m_per_s)
        };
        Self {
            form,
            speeds_m_per_s: [speed, other],
            ticks: [random.decades(2.0, 600.0), random.decades(2.0, 300.0)],
            shift: random.decades(1.0, 300.0),
            seed: random.0,
        }
    }

    /// A slightly changed motion, up to a speed (m/s).
    pub fn changed(&self, random: &mut Random, top_m_per_s: f64) -> Self {
        let size = random.decades(0.01, 0.5);
        let mut factor = || random.between(-size, size).exp();
        let speeds = self.speeds_m_per_s;
        let both = factor();
        let speeds_m_per_s = if speeds[0] == speeds[1] {
            speeds.map(|speed| (speed * both).min(top_m_per_s))
        } else {
            speeds.map(|speed| (speed * factor()).min(top_m_per_s))
        };
        let ticks = self.ticks.map(|ticks| (ticks * factor()).max(2.0));
        let shift = (self.shift * factor()).max(1.0);
        Self {
            speeds_m_per_s,
            ticks,
            shift,
            ..self.clone()
        }
    }

    /// The motion at ticks of `step_s` (s).
    pub fn motion(&self, step_s: f64) -> Motion {
        let mut x = vec![0.0];
        match self.form {
            Form::Saw => self.saw(&mut x, step_s, false),
            Form::MoveAndStop => self.saw(&mut x, step_s, true),
            Form::Pieces => self.pieces(&mut x, step_s),
            Form::Ride => self.ride(&mut x, step_s),
            Form::Harmonic => self.harmonic(&mut x, step_s),
            Form::Ramp => self.ramp(&mut x, step_s),
        }
        Motion::new(Kind::Other, self.speeds_m_per_s[0], x)
    }

    /// Continues at a speed (m/s), but not beyond the maximum distance.
    fn go(x: &mut Vec<f64>, step: f64, ticks: f64) {
        for _ in 0..ticks as usize {
            let last = x[x.len() - 1];
            let next = last + step;
            x.push(if next.abs() <= FARTHEST_M { next } else { last });
        }
    }

    fn saw(&self, x: &mut Vec<f64>, step_s: f64, rests: bool) {
        let [out, back] = self.speeds_m_per_s.map(|speed| speed * step_s);
        let [piece, rest] = self.ticks;
        // The way back has the same length; it takes proportionally more ticks if it is slower.
        let ratio = (out / back).clamp(0.02, 50.0);
        Self::go(x, out, self.shift);
        for number in 0..8 {
            if x.len() > MAX_TICKS {
                break;
            }
            let rest = if number == 3 {
                LONG_REST_TICKS.min(40.0 * rest)
            } else {
                rest
            };
            Self::go(x, 0.0, if rests { rest } else { 0.0 });
            if number % 2 == 0 {
                Self::go(x, -back, (piece * ratio).min(MAX_TICKS as f64));
            } else {
                Self::go(x, out, piece);
            }
        }
    }

    fn pieces(&self, x: &mut Vec<f64>, step_s: f64) {
        let mut random = Random(self.seed);
        let [top, _] = self.speeds_m_per_s;
        while x.len() < MAX_TICKS / 2 {
            let speed = random.decades(1e-2 * top, top);
            let signed = if random.happens(0.5) { speed } else { -speed };
            let ticks = random.decades(1.0, self.ticks[0]);
            Self::go(
                x,
                if random.happens(0.2) {
                    0.0
                } else {
                    signed * step_s
                },
                ticks,
            );
        }
    }

    fn ride(&self, x: &mut Vec<f64>, step_s: f64) {
        let mut random = Random(self.seed);
        let lines: Vec<[f64; 3]> = (0..40)
            .map(|_| {
                [
                    random.unit(),
                    TAU * random.decades(0.2, 20.0),
                    TAU * random.unit(),
                ]
            })
            .collect();
        let sum: f64 = lines.iter().map(|[share, ..]| share).sum();
        // With this scale, no sum of the harmonics is faster.
        let scale = self.speeds_m_per_s[0] / sum;
        x.extend((1..MAX_TICKS).map(|tick| {
            let t = tick as f64 * step_s;
            let line = |[share, angular, phase]: &[f64; 3]| {
                share / angular * ((angular * t + phase).sin() - phase.sin())
            };
            (scale * lines.iter().map(line).sum::<f64>()).clamp(-FARTHEST_M, FARTHEST_M)
        }));
    }

    fn harmonic(&self, x: &mut Vec<f64>, step_s: f64) {
        // The frequency is at most 20 Hz.
        let ticks = (4.0 * self.ticks[0]).max(0.05 / step_s);
        let amplitude = (self.speeds_m_per_s[0] * ticks * step_s / TAU).min(FARTHEST_M);
        x.extend((1..MAX_TICKS).map(|tick| amplitude * (TAU * tick as f64 / ticks).sin()));
    }

    fn ramp(&self, x: &mut Vec<f64>, step_s: f64) {
        let quarter = self.ticks[0].ceil();
        for direction in [1.0, -1.0, -1.0, 1.0] {
            for tick in 1..2 * quarter as usize {
                let share = 1.0 - (tick as f64 - quarter).abs() / quarter;
                Self::go(x, direction * share * self.speeds_m_per_s[0] * step_s, 1.0);
            }
            Self::go(x, 0.0, self.ticks[1]);
        }
    }
}
