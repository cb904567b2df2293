//! Frequency response by a swept sine: one motion of constant amplitude whose frequency rises by as many octaves in every minute, and the
//! first harmonic of the force by synchronous demodulation over a few cycles.
//!
//! `x = A sin phi`, `dphi/dt = 2 pi f`, `f = f_0 exp(r t)`; then `f` rises by `r` from cycle to cycle. The first harmonic at a frequency is that under a
//! triangle (Bartlett window) of [`WINDOW_CYCLES`] cycles about it, over the phase: it has double zeros at all other harmonics, so none of them leaks in
//! while its amplitude changes evenly. Where the stiffness goes with the power `p` of the frequency, the value errs by about
//! `p (p - 1)/2 (r/f)^2/6`: 1/6 is the window's variance in cycles.

use std::f64::consts::{LN_2, TAU};

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::STEP_RANGE_S;

use super::TestbenchError;
use super::bench_test::NOT_FOLLOWED;
use super::response::Response;
use dashpot_files::harmonic::Harmonic;

/// Cycles that a value is demodulated over.
pub const WINDOW_CYCLES: u32 = 2;

/// The window, by its name.
pub const WINDOW: &str = "Bartlett";

/// Most steps of a sweep: a few minutes of computing.
pub const MOST_STEPS: f64 = 2e9;

/// Cycles from rest before the first window.
const LEAD_CYCLES: f64 = 2.0;

/// Steps of the fastest cycle, where the shortest step allows as many.
const STEPS: f64 = 1000.0;

/// Half a window, cycles.
const HALF: f64 = WINDOW_CYCLES as f64 / 2.0;

/// The response at each of the rising `frequencies_hz` to one sweep through all of them at `amplitude_m`, by the core's step in double precision.
/// The sweep starts three cycles before the first, at half of it or above.
///
/// # Errors
/// A motion outside its range or faster than the damper's limit, a sweep too fast for the first frequency or too long; a damper that does not build.
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
    let most_velocity = amplitude_m * TAU * sweep.end_hz;
    let limits = &parameters.limits;
    if amplitude_m > limits.displacement_m && most_velocity <= limits.rate_m_per_s {
        return Err(TestbenchError::Displacement {
            amplitude_m,
            limit_m: limits.displacement_m,
        });
    }
    run(parameters, amplitude_m, &sweep, &mut windows)?
        .then_some(())
        .ok_or(TestbenchError::Velocity {
            velocity_m_per_s: most_velocity,
            limit_m_per_s: parameters.limits.rate_m_per_s,
        })?;
    let responses = windows.iter().map(|window| window.response(amplitude_m));
    Ok(responses.collect())
}

/// A rise of the frequency.
struct Sweep {
    start_hz: f64,
    end_hz: f64,
    /// `r` (1/s).
    rate_per_s: f64,
}

impl Sweep {
    fn new(from_hz: f64, to_hz: f64, octaves_per_minute: f64) -> Result<Self, TestbenchError> {
        let rate_per_s = octaves_per_minute * LN_2 / 60.0;
        let before = HALF + LEAD_CYCLES;
        let most = 0.5 * from_hz / before * 60.0 / LN_2;
        if !(octaves_per_minute > 0.0 && octaves_per_minute <= most) {
            return Err(TestbenchError::SweepRate {
                octaves_per_minute,
                from_hz,
                most,
            });
        }
        let sweep = Self {
            start_hz: from_hz - rate_per_s * before,
            end_hz: to_hz + rate_per_s * HALF,
            rate_per_s,
        };
        let steps = (sweep.end_hz / sweep.start_hz).ln() / rate_per_s / sweep.step_s();
        if steps > MOST_STEPS {
            return Err(TestbenchError::SweepSteps { steps });
        }
        Ok(sweep)
    }

    /// The step (s).
    fn step_s(&self) -> f64 {
        (1.0 / (self.end_hz * STEPS)).clamp(*STEP_RANGE_S.start(), *STEP_RANGE_S.end())
    }

    /// Cycles before a frequency is reached.
    fn cycles_at(&self, frequency_hz: f64) -> f64 {
        (frequency_hz - self.start_hz) / self.rate_per_s
    }
}

/// What is summed about a frequency.
#[derive(Default)]
struct Window {
    frequency_hz: f64,
    /// Cycles before it.
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

/// Moves the damper through the sweep; whether it followed all of it.
fn run(
    parameters: &CheckedParameters,
    amplitude_m: f64,
    sweep: &Sweep,
    windows: &mut [Window],
) -> Result<bool, TestbenchError> {
    let step_s = sweep.step_s();
    let damper = parameters.build::<f64>(step_s)?;
    let mut state = damper.at_rest(0.0);
    // Windows before this one are complete.
    let mut first = 0;
    for tick in 1_u64.. {
        let frequency_hz = sweep.start_hz * (sweep.rate_per_s * step_s * tick as f64).exp();
        let cycles = sweep.cycles_at(frequency_hz);
        let (sine, cosine) = (TAU * cycles.fract()).sin_cos();
        let force = damper.step(&mut state, amplitude_m * sine);
        let is_past = |window: &Window| cycles > window.centre + HALF;
        while windows.get(first).is_some_and(is_past) {
            first += 1;
        }
        if first == windows.len() {
            break;
        }
        for window in &mut windows[first..] {
            let from_centre = cycles - window.centre;
            if from_centre < -HALF {
                break;
            }
            // Over the phase, which advances with the frequency.
            let weight = (1.0 - from_centre.abs() / HALF) * frequency_hz;
            window.sine += weight * force * sine;
            window.cosine += weight * force * cosine;
            window.weight += weight;
        }
    }
    Ok(!state.status().intersects(NOT_FOLLOWED))
}
