//! Frequency response from a swept sine: the amplitude is constant and the frequency rises exponentially. Synchronous
//! demodulation over a few cycles yields the first harmonic of the force.
//!
//! `x = A sin phi`, `dphi/dt = 2 pi f`, `f = f_0 exp(r t)`, so `f` rises by `r` per cycle. The first harmonic at a
//! frequency is an integral over the phase with a triangular (Bartlett) window of [`WINDOW_CYCLES`] cycles, centred at
//! that frequency. The window has double zeros at all other harmonics, so none of them leaks in while its amplitude
//! changes linearly. If the stiffness is proportional to the power `p` of the frequency, the relative error is about
//! `p (p - 1)/2 (r/f)^2/6`; 1/6 is the variance of the window in cycles squared.

use std::f64::consts::{LN_2, TAU};

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::STEP_RANGE_S;

use super::TestbenchError;
use super::bench_test::NOT_FOLLOWED;
use super::limits::MAX_SWEEP_STEPS;
use super::response::Response;
use dashpot_files::harmonic::Harmonic;

/// Number of cycles over which a value is demodulated.
pub const WINDOW_CYCLES: u32 = 2;

/// Name of the window.
pub const WINDOW: &str = "Bartlett";

/// Number of cycles from rest to the first window.
const LEAD_CYCLES: f64 = 2.0;

/// Steps in the fastest cycle, if the minimum step allows that many.
const STEPS_PER_CYCLE: f64 = 1000.0;

/// Half the window width (cycles).
const HALF_WINDOW: f64 = WINDOW_CYCLES as f64 / 2.0;

/// Computes the response at each of `frequencies_hz`, in rising order, from one sweep through all of them.
///
/// Runs the core's step in double precision. The sweep starts three cycles before it reaches the first frequency; its
/// initial frequency is at least half of the first one.
///
/// # Errors
/// Returns an error for a motion out of range or beyond the damper's limits, a sweep that is too fast for the first
/// frequency or too long, or a damper that cannot be built.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::{response, swept_sine};
/// let damper = damper::load("reduced-vertical", &[])?;
/// let frequencies = [1.0, 4.0];
/// let one_by_one = response::at_amplitude(&damper, 2e-3, &frequencies)?;
/// for (found, harmonic) in swept_sine::responses(&damper, 2e-3, &frequencies, 1.0)?.iter().zip(&one_by_one) {
///     assert!(found.difference_from(harmonic).is_some_and(|difference| difference < 1e-3));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn responses(
    parameters: &CheckedParameters,
    amplitude_m: f64,
    frequencies_hz: &[f64],
    octaves_per_minute: f64,
) -> Result<Vec<Response>, TestbenchError> {
    let (Some(&from_hz), Some(&to_hz)) = (frequencies_hz.first(), frequencies_hz.last()) else {
        return Ok(Vec::new());
    };
    for &frequency_hz in frequencies_hz {
        let motion = Harmonic {
            amplitude_m,
            frequency_hz,
        };
        motion.check()?;
    }
    let sweep = Sweep::new(from_hz, to_hz, octaves_per_minute)?;
    let windows = frequencies_hz.iter().map(|&frequency_hz| Window {
        frequency_hz,
        centre: sweep.cycles_at(frequency_hz),
        ..Window::default()
    });
    let mut windows: Vec<Window> = windows.collect();
    let max_velocity = amplitude_m * TAU * sweep.end_hz;
    let limits = &parameters.limits;
    if amplitude_m > limits.displacement_m && max_velocity <= limits.rate_m_per_s {
        return Err(TestbenchError::Displacement {
            amplitude_m,
            limit_m: limits.displacement_m,
        });
    }
    run(parameters, amplitude_m, &sweep, &mut windows)?
        .then_some(())
        .ok_or(TestbenchError::Velocity {
            velocity_m_per_s: max_velocity,
            limit_m_per_s: parameters.limits.rate_m_per_s,
        })?;
    let responses = windows.iter().map(|window| window.response(amplitude_m));
    Ok(responses.collect())
}

/// An exponential frequency sweep.
struct Sweep {
    start_hz: f64,
    end_hz: f64,
    /// `r` (1/s).
    rate_per_s: f64,
}

impl Sweep {
    fn new(from_hz: f64, to_hz: f64, octaves_per_minute: f64) -> Result<Self, TestbenchError> {
        let rate_per_s = octaves_per_minute * LN_2 / 60.0;
        let cycles_before = HALF_WINDOW + LEAD_CYCLES;
        let max = 0.5 * from_hz / cycles_before * 60.0 / LN_2;
        if !(octaves_per_minute > 0.0 && octaves_per_minute <= max) {
            return Err(TestbenchError::SweepRate {
                octaves_per_minute,
                from_hz,
                max,
            });
        }
        let sweep = Self {
            start_hz: from_hz - rate_per_s * cycles_before,
            end_hz: to_hz + rate_per_s * HALF_WINDOW,
            rate_per_s,
        };
        let steps = (sweep.end_hz / sweep.start_hz).ln() / rate_per_s / sweep.step_s();
        if steps > MAX_SWEEP_STEPS {
            return Err(TestbenchError::SweepSteps { steps });
        }
        Ok(sweep)
    }

    /// Returns the step (s).
    fn step_s(&self) -> f64 {
        (1.0 / (self.end_hz * STEPS_PER_CYCLE)).clamp(*STEP_RANGE_S.start(), *STEP_RANGE_S.end())
    }

    /// Returns the number of cycles from the start of the sweep until it reaches a frequency.
    fn cycles_at(&self, frequency_hz: f64) -> f64 {
        (frequency_hz - self.start_hz) / self.rate_per_s
    }
}

/// Weighted sums over the window about one frequency.
#[derive(Default)]
struct Window {
    frequency_hz: f64,
    /// Cycle of the sweep, counted from its start, at which the window has its centre.
    centre: f64,
    sine: f64,
    cosine: f64,
    weight: f64,
}

impl Window {
    fn response(&self, amplitude_m: f64) -> Response {
        let scale = 2.0 / (self.weight * amplitude_m);
        Response {
            frequency_hz: self.frequency_hz,
            amplitude_m,
            storage_n_per_m: scale * self.sine,
            loss_n_per_m: scale * self.cosine,
        }
    }
}

/// Moves the damper through the sweep; returns true if the damper followed all of it.
fn run(
    parameters: &CheckedParameters,
    amplitude_m: f64,
    sweep: &Sweep,
    windows: &mut [Window],
) -> Result<bool, TestbenchError> {
    let step_s = sweep.step_s();
    let damper = parameters.build::<f64>(step_s)?;
    let mut state = damper.at_rest(0.0);
    // Windows before `first` are complete.
    let mut first = 0;
    for tick in 1_u64.. {
        let frequency_hz = sweep.start_hz * (sweep.rate_per_s * step_s * tick as f64).exp();
        let cycles = sweep.cycles_at(frequency_hz);
        let (sine, cosine) = (TAU * cycles.fract()).sin_cos();
        let force = damper.step(&mut state, amplitude_m * sine);
        let is_past = |window: &Window| cycles > window.centre + HALF_WINDOW;
        while windows.get(first).is_some_and(is_past) {
            first += 1;
        }
        if first == windows.len() {
            break;
        }
        for window in &mut windows[first..] {
            let from_centre = cycles - window.centre;
            if from_centre < -HALF_WINDOW {
                break;
            }
            // The weight contains the frequency because the integral is over the phase.
            let weight = (1.0 - from_centre.abs() / HALF_WINDOW) * frequency_hz;
            window.sine += weight * force * sine;
            window.cosine += weight * force * cosine;
            window.weight += weight;
        }
    }
    Ok(!state.status().intersects(NOT_FOLLOWED))
}
