//! Nonlinear critical speed: the lowest speed at which a lateral disturbance leads to a limit cycle of hunting.

use std::ops::RangeInclusive;

use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{RailSupport, Vehicle, VehicleError, VehicleParameters, VehicleState};
use serde::Serialize;

use super::VehicleRunError;
use super::contact::Contact;

/// Step size, s.
const STEP_S: f64 = 1e-3;

/// Initial lateral displacement of the bogies and wheelsets, m: up to flange contact.
const PUSH_M: f64 = 6e-3;

/// Settling time, s, and length of each of the two windows that follow, in which the amplitude is measured, s.
const SETTLING_S: f64 = 12.0;
const WINDOW_S: f64 = 3.0;

/// Minimum amplitude of a limit cycle, m.
const MIN_AMPLITUDE_M: f64 = 0.5e-3;
/// Minimum ratio of the amplitude in a window to that in the window before; a motion that decays faster dies out.
const MIN_AMPLITUDE_RATIO: f64 = 0.99;

/// Response to the initial displacement at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Outcome {
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Maximum lateral displacement of a wheelset in the last 3 s of 18 s, m.
    pub amplitude_m: f64,
    /// Maximum lateral displacement of a wheelset in the 3 s before, m.
    pub amplitude_before_m: f64,
}

impl Outcome {
    /// True if the wheelsets keep hunting.
    pub fn is_limit_cycle(&self) -> bool {
        self.amplitude_m > MIN_AMPLITUDE_M
            && self.amplitude_m >= MIN_AMPLITUDE_RATIO * self.amplitude_before_m
    }
}

/// Displaces all bodies except the first, the car body, to the right by `by_m`.
///
/// # Errors
/// State of another vehicle, or displacement over 10 m.
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

/// Search for hunting of a vehicle on straight ideal track.
pub struct Hunting {
    vehicle: Vehicle<KalkerBook>,
    track: Track,
}

impl Hunting {
    /// Builds the vehicle with the contact of each wheelset.
    ///
    /// # Errors
    /// Invalid vehicle parameters.
    pub fn new(
        parameters: &VehicleParameters,
        contacts: Vec<Contact>,
    ) -> Result<Self, VehicleRunError> {
        Ok(Self {
            vehicle: Vehicle::with_contacts(
                parameters,
                contacts,
                STEP_S,
                Some(RailSupport::BALLASTED),
            )?,
            track: Track::default(),
        })
    }

    /// Displaces the bogies and wheelsets laterally by 6 mm and simulates the response.
    ///
    /// # Errors
    /// Speed out of bounds.
    pub fn push(&self, speed_m_per_s: f64) -> Result<Outcome, VehicleRunError> {
        let vehicle = &self.vehicle;
        let mut state = vehicle.at_rest(&self.track, 0.0, speed_m_per_s)?;
        push_aside(vehicle, &mut state, &self.track, PUSH_M)?;
        let bodies = vehicle.names().len() - vehicle.wheelsets();
        let mut amplitudes = [0.0_f64; 2];
        let ticks = |seconds: f64| (seconds / STEP_S) as u64;
        for tick in 0..ticks(SETTLING_S + 2.0 * WINDOW_S) {
            vehicle.step(&mut state, &self.track);
            if state.is_diverged() {
                amplitudes = [f64::INFINITY; 2];
                break;
            }
            if tick >= ticks(SETTLING_S) {
                let lateral = state.coordinates()[bodies..].iter().map(|q| q[0].abs());
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

    /// Finds the lowest speed with a limit cycle in a range of speeds (m/s) by bisection to 0.1 m/s, and returns the
    /// response there. Returns `None` if the motion dies out at the upper end of the range.
    ///
    /// # Errors
    /// See [`Self::push`].
    pub fn critical(
        &self,
        speeds_m_per_s: RangeInclusive<f64>,
    ) -> Result<Option<Outcome>, VehicleRunError> {
        let mut unstable = self.push(*speeds_m_per_s.end())?;
        if !unstable.is_limit_cycle() {
            return Ok(None);
        }
        let mut stable_m_per_s = *speeds_m_per_s.start();
        while unstable.speed_m_per_s - stable_m_per_s > 0.1 {
            let outcome = self.push(0.5 * (unstable.speed_m_per_s + stable_m_per_s))?;
            if outcome.is_limit_cycle() {
                unstable = outcome;
            } else {
                stable_m_per_s = outcome.speed_m_per_s;
            }
        }
        Ok(Some(unstable))
    }
}
