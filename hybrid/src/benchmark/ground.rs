//! Motions of the ground.

use std::f64::consts::TAU;

use super::RATE_HZ;
use crate::sensor::Noise;

/// Largest acceleration of the benchmark's record, El Centro 1940 north-south at 40 % (m/s^2).
const PEAK_M_PER_S2: f64 = 0.4 * 3.417;
/// Time between two random numbers, which holds energy up to 25 Hz (s).
const SAMPLE_S: f64 = 0.02;

/// An earthquake of 45 s (m/s^2 at each tick): white noise through the filters of Kanai and Tajimi and of Clough and
/// Penzien for firm soil, with a rise of 2 s, a strong part of 8 s and a decay, at the peak of the benchmark's record.
pub fn earthquake(seed: u64) -> Vec<f64> {
    let mut noise = Noise::new(seed);
    let h = 1.0 / RATE_HZ;
    let ticks_of_sample = (SAMPLE_S * RATE_HZ) as usize;
    let (ground, high_pass) = ((15.0, 0.6), (1.5, 0.6));
    let filtered = |(omega, damping): (f64, f64), state: &mut [f64; 2], input: f64| {
        // Force of spring and damper on a mass under the acceleration `input`.
        let acceleration = -omega * omega * state[0] - 2.0 * damping * omega * state[1] - input;
        state[1] += h * acceleration;
        state[0] += h * state[1];
        omega * omega * state[0] + 2.0 * damping * omega * state[1]
    };
    let (mut of_ground, mut of_high_pass, mut random) = ([0.0; 2], [0.0; 2], 0.0);
    let mut record: Vec<f64> = (0..(45.0 * RATE_HZ) as usize)
        .map(|tick| {
            let t = tick as f64 * h;
            if tick % ticks_of_sample == 0 {
                random = noise.normal();
            }
            let envelope = match t {
                ..2.0 => (t / 2.0) * (t / 2.0),
                ..10.0 => 1.0,
                ..35.0 => libm::exp(-0.12 * (t - 10.0)),
                _ => 0.0,
            };
            let shaken = -filtered(ground, &mut of_ground, envelope * random);
            shaken + filtered(high_pass, &mut of_high_pass, shaken)
        })
        .collect();
    let peak = record.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    for acceleration in &mut record {
        *acceleration *= PEAK_M_PER_S2 / peak;
    }
    record
}

/// A sine of 0.24 m/s^2 whose frequency rises from 0.1 to 10 Hz in 60 s (m/s^2 at each tick).
pub fn chirp() -> Vec<f64> {
    let (from_hz, to_hz, duration_s) = (0.1, 10.0, 60.0);
    let at = |tick: usize| {
        let t = tick as f64 / RATE_HZ;
        let cycles = from_hz * t + 0.5 * (to_hz - from_hz) * t * t / duration_s;
        0.24 * libm::sin(TAU * cycles)
    };
    (0..(duration_s * RATE_HZ) as usize).map(at).collect()
}

/// A record (s, m/s^2) at each tick from its first time to its last, on straight lines between its rows.
///
/// ```
/// use dashpot_hybrid::benchmark::at_ticks;
///
/// let ground = at_ticks(&[(0.0, 0.0), (1.0, 4.096)]);
/// assert_eq!((ground.len(), ground[0]), (4097, 0.0));
/// assert!((ground[4000] - 4.0).abs() < 1e-9);
/// ```
pub fn at_ticks(record: &[(f64, f64)]) -> Vec<f64> {
    let (Some((first_s, _)), Some((last_s, _))) = (record.first(), record.last()) else {
        return Vec::new();
    };
    let mut row = 0;
    (0..=((last_s - first_s) * RATE_HZ) as usize)
        .map(|tick| {
            let t = first_s + tick as f64 / RATE_HZ;
            while row + 2 < record.len() && record[row + 1].0 <= t {
                row += 1;
            }
            let next = (row + 1).min(record.len() - 1);
            let ((t0, a0), (t1, a1)) = (record[row], record[next]);
            match t1 > t0 {
                true => a0 + (a1 - a0) * (t - t0) / (t1 - t0),
                false => a0,
            }
        })
        .collect()
}
