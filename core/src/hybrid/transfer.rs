//! Compensator, tracking, energy and guard in one tick.

use super::compensator::Compensator;
use super::energy::{AddedEnergy, EnergySettings};
use super::guard::{Guard, GuardSettings};
use super::limits;
use super::motion::Motion;
use super::status::HybridStatus;
use super::tracking::{Tracking, TrackingReading};
use crate::BuildError;

/// Measured values of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Displacement of the damper's ends (m), positive in extension.
    pub displacement_m: f32,
    /// Force of the damper (N), positive when it resists extension.
    pub force_n: f32,
}

/// Result of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// Command of the actuator (m).
    pub command_m: f32,
    /// Force for the vehicle (N): the measured one, or the last valid one; after the end of a test it fades to 0.
    pub force_n: f32,
    /// Status bits since the last [`Guard::clear`].
    pub status: HybridStatus,
}

/// Settings of a [`TransferSystem`] except those of its compensator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferSettings {
    /// Limits of the test.
    pub guard: GuardSettings,
    /// Alarm of the added energy.
    pub energy: EnergySettings,
    /// Time after which past motion counts 1/e in the tracking (s), 0.05 to 1000.
    pub tracking_window_s: f32,
    /// Error of the tracking over that window that ends a test, relative to the desired motion (1), 0.01 to 100.
    /// Errors below a hundredth of [`GuardSettings::error_m`] do not count, and those of the first window neither.
    pub tracking_error: f32,
}

/// All that stands between a simulated vehicle and an actuator.
///
/// ```
/// use dashpot_core::hybrid::{
///     EnergySettings, GuardSettings, InverseModel, Measured, Motion, TransferSettings, TransferSystem,
/// };
///
/// let settings = TransferSettings {
///     guard: GuardSettings::new(0.1, 1.0, 20e3),
///     energy: EnergySettings::default(),
///     tracking_window_s: 1.0,
///     tracking_error: 0.3,
/// };
/// let mut transfer = TransferSystem::new(InverseModel::of_delay(0.01)?, &settings, 1e-3)?;
/// let desired = Motion { velocity_m_per_s: 0.01, ..Motion::at_rest(0.0) };
/// let command = transfer.tick(&desired, Some(Measured::default()));
/// assert!(command.status.is_empty());
/// assert!((command.command_m - 0.05e-3).abs() < 1e-10); // it approaches at 0.05 m/s
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TransferSystem<C> {
    compensator: C,
    tracking: Tracking,
    energy: AddedEnergy,
    guard: Guard,
    /// Ticks in which the force for the vehicle fades after the end, and those that are left.
    fading_ticks: u32,
    fading_left: u32,
    share_of_tick: f32,
    /// The last measured force before the end (N).
    force_n: f32,
    was_running: bool,
    tracking_error: f32,
    least_error_m: f32,
    /// Ticks of the tracking's window, and those of a running test that are left before its error counts.
    window_ticks: u32,
    window_left: u32,
}

impl<C: Compensator> TransferSystem<C> {
    /// A transfer system at rest at 0.
    ///
    /// # Errors
    /// A setting is outside its range.
    pub fn new(
        compensator: C,
        settings: &TransferSettings,
        step_s: f32,
    ) -> Result<Self, BuildError> {
        limits::within(
            ("tracking", "error"),
            settings.tracking_error,
            (0.01, 100.0),
            "0.01 to 100",
        )?;
        let window_ticks = (settings.tracking_window_s / step_s) as u32;
        let fading_ticks = libm::ceilf(settings.guard.ramp_s / step_s) as u32;
        Ok(Self {
            compensator,
            tracking: Tracking::new(settings.tracking_window_s, step_s)?,
            energy: AddedEnergy::new(&settings.energy, step_s)?,
            guard: Guard::new(&settings.guard, step_s)?,
            fading_ticks,
            fading_left: fading_ticks,
            share_of_tick: 1.0 / fading_ticks as f32,
            force_n: 0.0,
            was_running: false,
            tracking_error: settings.tracking_error,
            least_error_m: 0.01 * settings.guard.error_m,
            window_ticks,
            window_left: window_ticks,
        })
    }

    /// Places a transfer system that has not ended a test at the actuator's present displacement (m).
    pub fn place(&mut self, displacement_m: f32) {
        self.guard.place(displacement_m);
    }

    /// Takes the desired motion and the measured values of this tick, or none if none came; returns the command and the
    /// force for the vehicle.
    #[inline]
    pub fn tick(&mut self, desired: &Motion, measured: Option<Measured>) -> Command {
        let pair = measured.map(|measured| (measured.displacement_m, measured.force_n));
        let wanted_m = self.compensator.command_m(desired);
        let command_m = self.guard.step(wanted_m, desired.displacement_m, pair);
        let (displacement_m, force_n) = self.guard.last_measured();
        let is_running = self.guard.is_running();
        let has_started = is_running && !self.was_running;
        self.was_running = is_running;
        self.tracking.observe(desired, displacement_m);
        // The tick that starts a test does nothing that other ticks do, so it does not take longer.
        if has_started {
            self.compensator.rest_at(desired.displacement_m);
            self.energy.rest_at(desired.displacement_m, force_n);
        } else {
            self.energy
                .observe(desired.displacement_m, displacement_m, force_n);
            if is_running {
                self.compensator.observe(command_m, displacement_m);
            }
        }
        let mut found = HybridStatus::ENERGY.only_if(self.energy.is_alarm());
        found |= HybridStatus::SIGN.only_if(self.energy.is_reversed());
        let is_off = (self.tracking).is_off(self.tracking_error, self.least_error_m);
        found |= HybridStatus::TRACKING.only_if(is_off && self.window_left == 0);
        self.window_left = match is_running {
            true => self.window_left.saturating_sub(1),
            false => self.window_ticks,
        };
        if is_running && !found.is_empty() {
            self.guard.end(found);
        }
        // What a rig measures while it comes to rest is no force of the test: after a gap it would jump.
        match self.guard.has_ended() {
            true => self.fading_left = self.fading_left.saturating_sub(1),
            false => {
                self.fading_left = (self.fading_left + 1).min(self.fading_ticks);
                self.force_n = force_n;
            }
        }
        Command {
            command_m,
            force_n: self.fading_left as f32 * self.share_of_tick * self.force_n,
            status: self.guard.status(),
        }
    }

    /// The compensator.
    pub fn compensator(&self) -> &C {
        &self.compensator
    }

    /// Delay, amplitude and errors over the fading past.
    pub fn tracking(&self) -> TrackingReading {
        self.tracking.reading()
    }

    /// The energy that the actuator adds.
    pub fn energy(&self) -> &AddedEnergy {
        &self.energy
    }

    /// The guard, to see its state, to end a test or to clear it.
    pub fn guard(&mut self) -> &mut Guard {
        &mut self.guard
    }
}
