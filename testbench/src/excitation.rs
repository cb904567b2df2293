//! Synthetic excitations: displacement as a closed-form function of time, for the demonstration, tests and benches.
//!
//! The functions of `libm` give the same samples on every machine.

use std::f64::consts::TAU;

use libm::{exp, log, sin};

/// A synthetic excitation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excitation {
    /// Random ride, 0.4-20 Hz, shaped by a body mode at 1.4 Hz, rms velocity 0.04 m/s.
    Ride,
    /// Logarithmic sweep 0.2-25 Hz at 0.8 mm.
    Sweep,
    /// Triangular motion at 0.1 m/s between +-12.5 mm, then rest.
    Saw,
    /// Decaying oscillation at 1.4 Hz from 10 mm.
    Decay,
    /// 26 mm at 2 Hz: the compression force of the published damper comes within 0.5 % of its limit.
    Stroke,
    /// Strokes out and back with linearly rising and falling velocity, to 0.1, 0.4 and 1.6 m/s: passes every corner of
    /// every law.
    Ramp,
}

impl Excitation {
    /// All excitations.
    pub const ALL: [Self; 6] = [
        Self::Ride,
        Self::Sweep,
        Self::Saw,
        Self::Decay,
        Self::Stroke,
        Self::Ramp,
    ];

    /// Returns the name used in tables and file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ride => "ride",
            Self::Sweep => "sweep",
            Self::Saw => "saw",
            Self::Decay => "decay",
            Self::Stroke => "stroke",
            Self::Ramp => "ramp",
        }
    }

    /// Returns the duration (s).
    pub fn duration_s(self) -> f64 {
        match self {
            Self::Sweep => 10.0,
            Self::Stroke => 2.0,
            Self::Ramp => 4.0,
            _ => 5.0,
        }
    }

    /// Returns the displacement (m) at each tick of `step_s` (s); the first is 0.
    pub fn displacements_m(self, step_s: f64) -> Vec<f64> {
        let ticks = (self.duration_s() / step_s).round() as usize;
        let time = (0..=ticks).map(|tick| tick as f64 * step_s);
        match self {
            Self::Ride => {
                let lines = ride_lines();
                time.map(|t| {
                    lines
                        .iter()
                        .map(|line| line.at(t) - line.at(0.0))
                        .sum::<f64>()
                })
                .collect()
            }
            Self::Sweep => time.map(sweep).collect(),
            Self::Saw => time.map(saw).collect(),
            Self::Decay => time
                .map(|t| 0.01 * exp(-t / 0.5) * sin(TAU * 1.4 * t))
                .collect(),
            Self::Stroke => time.map(|t| 0.026 * sin(TAU * 2.0 * t)).collect(),
            Self::Ramp => time.map(ramp).collect(),
        }
    }
}

struct Line {
    amplitude_m: f64,
    frequency_hz: f64,
    phase: f64,
}

impl Line {
    fn at(&self, time_s: f64) -> f64 {
        self.amplitude_m * sin(TAU * self.frequency_hz * time_s + self.phase)
    }
}

/// Returns the spectral lines of the ride: white base motion filtered by a mode at 1.4 Hz with damping ratio 0.3.
fn ride_lines() -> Vec<Line> {
    const LINES: u32 = 98;
    const VELOCITY_RMS: f64 = 0.04;
    let mut seed = 0x2545_f491_u32;
    let mut uniform = || {
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        f64::from(seed) / f64::from(u32::MAX)
    };
    let mut lines: Vec<Line> = (0..LINES)
        .map(|index| {
            let frequency_hz = 0.4 + 0.2 * (f64::from(index) + uniform());
            let ratio = frequency_hz / 1.4;
            let mode = ((1.0 - ratio * ratio).powi(2) + (0.6 * ratio).powi(2)).sqrt();
            Line {
                amplitude_m: 1.0 / mode,
                frequency_hz,
                phase: TAU * uniform(),
            }
        })
        .collect();
    let square: f64 = lines
        .iter()
        .map(|line| (TAU * line.frequency_hz * line.amplitude_m).powi(2) / 2.0)
        .sum();
    for line in &mut lines {
        line.amplitude_m *= VELOCITY_RMS / square.sqrt();
    }
    lines
}

fn sweep(time_s: f64) -> f64 {
    const FROM_HZ: f64 = 0.2;
    const TO_HZ: f64 = 25.0;
    let rate = log(TO_HZ / FROM_HZ) / Excitation::Sweep.duration_s();
    0.8e-3 * sin(TAU * FROM_HZ * (exp(rate * time_s) - 1.0) / rate)
}

fn saw(time_s: f64) -> f64 {
    const AMPLITUDE: f64 = 0.0125;
    if time_s >= 3.0 {
        return 0.0;
    }
    let phase = (time_s / 0.5).fract();
    let quarter = |phase: f64| AMPLITUDE * phase / 0.25;
    if phase < 0.25 {
        quarter(phase)
    } else if phase < 0.75 {
        quarter(0.5 - phase)
    } else {
        quarter(phase - 1.0)
    }
}

fn ramp(time_s: f64) -> f64 {
    /// Peak velocity (m/s) and duration (s) of each stroke; each goes out and back.
    const STROKES: [(f64, f64); 3] = [(0.1, 0.8), (0.4, 0.4), (1.6, 0.16)];
    let mut start = 0.0;
    for (velocity, duration) in STROKES {
        let length = 0.5 * velocity * duration;
        // Displacement, from 0 to 1, as a function of the completed fraction of a stroke.
        let along = |fraction: f64| {
            if fraction < 0.5 {
                length * 2.0 * fraction * fraction
            } else {
                length * (1.0 - 2.0 * (1.0 - fraction) * (1.0 - fraction))
            }
        };
        let fraction = (time_s - start) / duration;
        if fraction < 1.0 {
            return along(fraction);
        }
        if fraction < 2.0 {
            return length - along(fraction - 1.0);
        }
        start += 2.0 * duration;
    }
    0.0
}
