//! The nonlinear critical speed: the least at which a push grows into, or stays, a limit cycle of hunting.

use std::sync::Arc;

use dashpot_rail::contact::WheelsetContact;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleError, VehicleParameters, VehicleState};
use serde::Serialize;

use super::VehicleRunError;

/// Step, s.
const STEP_S: f64 = 1e-3;

/// By how much all wheelsets and the bogies are pushed aside at the start, m: to the flange.
const PUSH_M: f64 = 6e-3;

/// Time until a motion has settled, s, and over which its amplitude is taken then.
const SETTLING_S: f64 = 12.0;
const WINDOW_S: f64 = 3.0;

/// Least amplitude of a limit cycle, m, and least ratio of its amplitude to that of the window before: what falls faster dies away.
const AMPLITUDE_M: f64 = 0.5e-3;
const KEPT: f64 = 0.99;

/// What becomes of a push at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Outcome {
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Greatest lateral displacement of a wheelset in the last 3 of 18 s, m.
    pub amplitude_m: f64,
    /// The same in the 3 s before.
    pub amplitude_before_m: f64,
}

impl Outcome {
    /// Whether the wheelsets go on hunting.
    pub fn is_limit_cycle(&self) -> bool {
        self.amplitude_m > AMPLITUDE_M && self.amplitude_m >= KEPT * self.amplitude_before_m
    }
}

/// Moves all bodies but the first, which is the car body, to the right.
///
/// # Errors
/// A state of another vehicle, more than 10 m.
pub(super) fn push_aside(
    vehicle: &Vehicle<KalkerBook>,
    state: &mut VehicleState,
    track: &Track,
    by_m: f64,
) -> Result<(), VehicleError> {
    for body in 1..vehicle.names().len() {
        vehicle.displace(state, track, body, [by_m, 0.0, 0.0, 0.0, 0.0])?;
    }
    Ok(())
}

/// A vehicle that is pushed, on straight ideal track.
pub struct Hunting {
    vehicle: Vehicle<KalkerBook>,
    track: Track,
}

impl Hunting {
    /// Of a vehicle with `contact`.
    ///
    /// # Errors
    /// A vehicle that is refused.
    pub fn new(
        parameters: &VehicleParameters,
        contact: Arc<WheelsetContact<KalkerBook>>,
    ) -> Result<Self, VehicleRunError> {
        Ok(Self {
            vehicle: Vehicle::new(parameters, contact, STEP_S)?,
            track: Track::default(),
        })
    }

    /// Pushes every wheelset and what carries it aside, and runs on.
    ///
    /// # Errors
    /// A speed out of bounds.
    pub fn push(&self, speed_m_per_s: f64) -> Result<Outcome, VehicleRunError> {
        let vehicle = &self.vehicle;
        let mut state = vehicle.at_rest(&self.track, 0.0, speed_m_per_s)?;
        push_aside(vehicle, &mut state, &self.track, PUSH_M)?;
        let wheelsets = vehicle.names().len() - vehicle.wheelsets();
        let mut amplitudes = [0.0_f64; 2];
        let ticks = |seconds: f64| (seconds / STEP_S) as u64;
        for tick in 0..ticks(SETTLING_S + 2.0 * WINDOW_S) {
            vehicle.step(&mut state, &self.track);
            if state.is_diverged() {
                amplitudes = [f64::INFINITY; 2];
                break;
            }
            if tick >= ticks(SETTLING_S) {
                let lateral = state.coordinates()[wheelsets..].iter().map(|q| q[0].abs());
                let window = usize::from(tick >= ticks(SETTLING_S + WINDOW_S));
                amplitudes[window] = lateral.fold(amplitudes[window], f64::max);
            }
        }
        let [amplitude_before_m, amplitude_m] = amplitudes;
        Ok(Outcome {
            speed_m_per_s,
            amplitude_m,
            amplitude_before_m,
        })
    }

    /// The least speed with a limit cycle from `least` to `greatest`, m/s, halved to 0.1 m/s, and the cycle there; none where a push dies
    /// away at the greatest.
    ///
    /// # Errors
    /// As [`Self::push`].
    pub fn critical(
        &self,
        [least, greatest]: [f64; 2],
    ) -> Result<Option<Outcome>, VehicleRunError> {
        let mut growing = self.push(greatest)?;
        if !growing.is_limit_cycle() {
            return Ok(None);
        }
        let mut dying = least;
        while growing.speed_m_per_s - dying > 0.1 {
            let outcome = self.push(0.5 * (growing.speed_m_per_s + dying))?;
            if outcome.is_limit_cycle() {
                growing = outcome;
            } else {
                dying = outcome.speed_m_per_s;
            }
        }
        Ok(Some(growing))
    }
}
