//! Limits of a test, and its end without a step of the command.

use super::limits::{self, clamped};
use super::status::HybridStatus;
use crate::BuildError;

const SECTION: &str = "guard";

/// How the guard ends a test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GuardAction {
    /// Stop, and hold the displacement.
    #[default]
    Hold,
    /// Stop, and move back by the measured force divided by the stiffness of the specimen, which leaves it without
    /// force. Without a valid measurement, the displacement is held.
    ZeroForce,
}

/// Limits of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuardSettings {
    /// Largest magnitude of the command (m), 1e-4 to 1.
    pub stroke_m: f32,
    /// Largest rate of the command (m/s), 1e-3 to 10. A faster command is limited.
    pub velocity_m_per_s: f32,
    /// Time for which the command may be limited without a break (s), 0 to 10.
    pub limited_s: f32,
    /// Largest magnitude of the measured force (N), 1 to 1e7.
    pub force_n: f32,
    /// Largest difference between measured and desired displacement (m), 1e-5 to 1.
    pub error_m: f32,
    /// Time for which the difference may be larger (s), 0 to 10.
    pub error_s: f32,
    /// Longest time without a valid measurement (s), 0 to 10.
    pub age_s: f32,
    /// Largest rate of a measured displacement that is plausible (m/s), 1e-3 to 1000.
    pub plausible_m_per_s: f32,
    /// Largest rate of a measured force that is plausible (N/s), 1 to 1e12.
    pub plausible_n_per_s: f32,
    /// Travel of the command (m) during which a measured value may stay the same to the last bit, 1e-6 to 1.
    pub stuck_travel_m: f32,
    /// Magnitude of the measured force below which the specimen counts as one without force (N), 0 to 1e7; 0 switches
    /// the check off.
    pub least_force_n: f32,
    /// Travel of the command (m) during which the specimen may be without force, 1e-6 to 100. A worn damper has none
    /// within its clearance.
    pub without_force_m: f32,
    /// Time in which the command comes to rest (s), 0.01 to 10.
    pub ramp_s: f32,
    /// Rate at which the command approaches the desired displacement at the start (m/s), 1e-4 to 1.
    pub approach_m_per_s: f32,
    /// How a test ends.
    pub action: GuardAction,
    /// Stiffness of the specimen, for [`GuardAction::ZeroForce`] (N/m), 1e3 to 1e12.
    pub stiffness_n_per_m: f32,
}

impl GuardSettings {
    /// Limits for an actuator with this stroke (m), velocity (m/s) and force (N), with the times of a usual test.
    pub fn new(stroke_m: f32, velocity_m_per_s: f32, force_n: f32) -> Self {
        Self {
            stroke_m,
            velocity_m_per_s,
            limited_s: 0.1,
            force_n,
            error_m: 0.2 * stroke_m,
            error_s: 0.05,
            age_s: 0.01,
            plausible_m_per_s: 4.0 * velocity_m_per_s,
            plausible_n_per_s: 1000.0 * force_n,
            stuck_travel_m: 0.02 * stroke_m,
            least_force_n: 0.002 * force_n,
            without_force_m: stroke_m,
            ramp_s: 0.2,
            approach_m_per_s: 0.05 * velocity_m_per_s,
            action: GuardAction::Hold,
            stiffness_n_per_m: 1e7,
        }
    }

    fn check(&self) -> Result<(), BuildError> {
        for (field, value, range, allowed) in [
            ("stroke_m", self.stroke_m, (1e-4, 1.0), "1e-4 to 1"),
            (
                "velocity_m_per_s",
                self.velocity_m_per_s,
                (1e-3, 10.0),
                "1e-3 to 10",
            ),
            ("limited_s", self.limited_s, (0.0, 10.0), "0 to 10"),
            ("force_n", self.force_n, (1.0, 1e7), "1 to 1e7"),
            ("error_m", self.error_m, (1e-5, 1.0), "1e-5 to 1"),
            ("error_s", self.error_s, (0.0, 10.0), "0 to 10"),
            ("age_s", self.age_s, (0.0, 10.0), "0 to 10"),
            (
                "plausible_m_per_s",
                self.plausible_m_per_s,
                (1e-3, 1e3),
                "1e-3 to 1000",
            ),
            (
                "plausible_n_per_s",
                self.plausible_n_per_s,
                (1.0, 1e12),
                "1 to 1e12",
            ),
            (
                "stuck_travel_m",
                self.stuck_travel_m,
                (1e-6, 1.0),
                "1e-6 to 1",
            ),
            ("least_force_n", self.least_force_n, (0.0, 1e7), "0 to 1e7"),
            (
                "without_force_m",
                self.without_force_m,
                (1e-6, 100.0),
                "1e-6 to 100",
            ),
            ("ramp_s", self.ramp_s, (0.01, 10.0), "0.01 to 10"),
            (
                "approach_m_per_s",
                self.approach_m_per_s,
                (1e-4, 1.0),
                "1e-4 to 1",
            ),
            (
                "stiffness_n_per_m",
                self.stiffness_n_per_m,
                (1e3, 1e12),
                "1e3 to 1e12",
            ),
        ] {
            limits::within((SECTION, field), value, range, allowed)?;
        }
        Ok(())
    }
}

/// Phase of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// The command moves slowly to the desired displacement.
    Approaching,
    Running,
    /// The command comes to rest.
    Ending,
    /// The command stays.
    Held,
}

/// Checks commands and measured values each tick. When a limit is exceeded, the command comes to rest in a stated time
/// and stays there until [`Guard::clear`].
///
/// The command never moves by more than the velocity limit times the step from one tick to the next, whatever happens,
/// beyond the resolution of single precision (1.2e-7 of the command).
/// Limits are latched with their reason.
///
/// ```
/// use dashpot_core::hybrid::{Guard, GuardSettings, HybridStatus};
///
/// let mut guard = Guard::new(&GuardSettings::new(0.1, 1.0, 20e3), 1e-3)?;
/// let first = guard.step(0.0, 0.0, Some((0.0, 0.0)));
/// let jump = guard.step(f32::NAN, 0.0, Some((0.0, 0.0)));
/// assert_eq!((first, jump), (0.0, 0.0));
/// assert_eq!(guard.status(), HybridStatus::STROKE);
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Guard {
    settings: GuardSettings,
    step_s: f32,
    phase: Phase,
    status: HybridStatus,
    command_m: f32,
    /// Change of the command in the last tick (m).
    change_m: f32,
    /// Last valid measurement: displacement (m) and force (N).
    displacement_m: f32,
    force_n: f32,
    /// Travel of the command since each measured value changed (m).
    displacement_same_m: f32,
    force_same_m: f32,
    /// Travel of the command since the specimen had a force (m).
    without_force_m: f32,
    /// Numbers of ticks without a break, and their limits: without a valid measurement, with a limited command, with a
    /// large error.
    age: u32,
    limited: u32,
    off: u32,
    most_age: u32,
    most_limited: u32,
    most_off: u32,
    /// Course of the end: position and change per tick at its beginning, way to the position without force (m), time
    /// since then, and duration (s).
    from_m: f32,
    from_change_m: f32,
    release_m: f32,
    ending_s: f32,
    duration_s: f32,
}

impl Guard {
    /// A guard that holds 0 until the first tick.
    ///
    /// # Errors
    /// A setting is outside its range.
    pub fn new(settings: &GuardSettings, step_s: f32) -> Result<Self, BuildError> {
        limits::step(SECTION, step_s)?;
        settings.check()?;
        // A time that is a whole number of ticks must not lose one by rounding.
        let ticks = |time_s: f32| (time_s / step_s + 0.01) as u32;
        Ok(Self {
            settings: *settings,
            step_s,
            phase: Phase::Approaching,
            status: HybridStatus::empty(),
            command_m: 0.0,
            change_m: 0.0,
            displacement_m: 0.0,
            force_n: 0.0,
            displacement_same_m: 0.0,
            force_same_m: 0.0,
            without_force_m: 0.0,
            age: 0,
            limited: 0,
            off: 0,
            most_age: ticks(settings.age_s),
            most_limited: ticks(settings.limited_s),
            most_off: ticks(settings.error_s),
            from_m: 0.0,
            from_change_m: 0.0,
            release_m: 0.0,
            ending_s: 0.0,
            duration_s: 0.0,
        })
    }

    /// Status bits since the last [`Guard::clear`].
    pub fn status(&self) -> HybridStatus {
        self.status
    }

    /// True while the command follows the wanted one.
    pub fn is_running(&self) -> bool {
        self.phase == Phase::Running
    }

    /// True after the end, when the command no longer moves.
    pub fn is_held(&self) -> bool {
        self.phase == Phase::Held
    }

    /// True from the end of a test until [`Guard::clear`].
    pub fn has_ended(&self) -> bool {
        matches!(self.phase, Phase::Ending | Phase::Held)
    }

    /// The last valid measured displacement (m) and force (N).
    pub fn last_measured(&self) -> (f32, f32) {
        (self.displacement_m, self.force_n)
    }

    /// Places a guard that has not ended a test at the actuator's present displacement (m), from which the command
    /// approaches the desired one.
    pub fn place(&mut self, displacement_m: f32) {
        if !self.has_ended() {
            self.phase = Phase::Approaching;
            self.command_m = clamped(displacement_m, self.settings.stroke_m);
            self.displacement_m = self.command_m;
            self.change_m = 0.0;
        }
    }

    /// Ends the test for a reason that another part found.
    pub fn end(&mut self, reason: HybridStatus) {
        self.status |= reason;
        if !self.has_ended() {
            self.begin_to_end();
        }
    }

    /// Clears the status. A test that has come to rest starts again: the command approaches the desired displacement.
    /// While the command is still coming to rest, nothing is cleared and the result is false.
    pub fn clear(&mut self) -> bool {
        if self.phase == Phase::Ending {
            return false;
        }
        self.status = HybridStatus::empty();
        self.phase = Phase::Approaching;
        (self.age, self.limited, self.off) = (0, 0, 0);
        (self.displacement_same_m, self.force_same_m) = (0.0, 0.0);
        self.without_force_m = 0.0;
        true
    }

    /// Takes the wanted command (m), the desired displacement (m), and measured displacement (m) and force (N), or none
    /// if none came. Returns the command to send (m).
    #[inline]
    pub fn step(&mut self, wanted_m: f32, desired_m: f32, measured: Option<(f32, f32)>) -> f32 {
        let mut found = self.measure(measured);
        let most = self.settings.velocity_m_per_s * self.step_s;
        let stroke_m = self.settings.stroke_m;
        // False for numbers that are none.
        let in_stroke = wanted_m.abs() <= stroke_m && desired_m.abs() <= stroke_m;
        found |= HybridStatus::STROKE.only_if(!in_stroke);
        let way = wanted_m - self.command_m;
        let is_running = self.phase == Phase::Running;
        let is_limited = is_running && way.abs() > most;
        self.limited = counted(is_limited, self.limited);
        found |= HybridStatus::COMMAND_LIMITED.only_if(is_limited);
        found |= HybridStatus::VELOCITY.only_if(self.limited > self.most_limited);
        let is_off = is_running && (self.displacement_m - desired_m).abs() > self.settings.error_m;
        self.off = counted(is_off, self.off);
        found |= HybridStatus::TRACKING.only_if(self.off > self.most_off);

        self.status |= found;
        let change = match self.phase {
            Phase::Approaching | Phase::Running if found.intersects(HybridStatus::ENDING) => {
                self.begin_to_end();
                self.ending_change()
            }
            Phase::Running => way,
            Phase::Approaching => {
                let slow = self.settings.approach_m_per_s * self.step_s;
                if way.abs() <= slow {
                    self.phase = Phase::Running;
                }
                clamped(way, slow)
            }
            Phase::Ending => self.ending_change(),
            Phase::Held => 0.0,
        };
        let next = clamped(self.command_m + clamped(change, most), stroke_m);
        self.change_m = next - self.command_m;
        let travel = self.change_m.abs();
        self.displacement_same_m += travel;
        self.force_same_m += travel;
        self.without_force_m += travel;
        self.command_m = next;
        next
    }

    /// Takes the measured values; returns what is wrong with them.
    #[inline]
    fn measure(&mut self, measured: Option<(f32, f32)>) -> HybridStatus {
        let settings = &self.settings;
        let since_s = self.step_s * (self.age as f32 + 1.0);
        let mut found = HybridStatus::empty();
        let (displacement, force) = measured.unwrap_or((f32::NAN, f32::NAN));
        // The first measurement of all has nothing to be compared with.
        let is_first = self.phase == Phase::Approaching;
        let moved = (displacement - self.displacement_m).abs();
        let changed = (force - self.force_n).abs();
        let is_plausible = moved <= settings.plausible_m_per_s * since_s
            && changed <= settings.plausible_n_per_s * since_s;
        let is_valid =
            is_plausible || (is_first && moved < f32::INFINITY && changed < f32::INFINITY);
        if is_valid {
            self.displacement_same_m = if moved > 0.0 {
                0.0
            } else {
                self.displacement_same_m
            };
            self.force_same_m = if changed > 0.0 {
                0.0
            } else {
                self.force_same_m
            };
            self.without_force_m = if force.abs() >= settings.least_force_n {
                0.0
            } else {
                self.without_force_m
            };
            (self.displacement_m, self.force_n) = (displacement, force);
            self.age = 0;
        } else {
            self.age = self.age.saturating_add(1);
            found |= HybridStatus::MEASUREMENT_MISSED;
            let too_old = self.age > self.most_age;
            found |= HybridStatus::AGE.only_if(too_old && measured.is_none());
            found |= HybridStatus::IMPLAUSIBLE.only_if(too_old && measured.is_some());
        }
        let is_stuck = self.displacement_same_m > settings.stuck_travel_m
            || self.force_same_m > settings.stuck_travel_m;
        let is_running = self.phase == Phase::Running;
        found |= HybridStatus::IMPLAUSIBLE.only_if(is_stuck && is_running);
        let is_loose = self.without_force_m > settings.without_force_m;
        found |= HybridStatus::NO_FORCE.only_if(is_loose && is_running);
        found | HybridStatus::FORCE.only_if(self.force_n.abs() > settings.force_n)
    }

    /// Plans the end: the velocity falls to zero evenly, and the way to the position without force has a smooth start
    /// and end. The time is longer than stated if the way would need more than half the velocity limit.
    fn begin_to_end(&mut self) {
        let settings = &self.settings;
        let is_releasing = settings.action == GuardAction::ZeroForce && self.age == 0;
        self.release_m = match is_releasing {
            true => clamped(
                -self.force_n / settings.stiffness_n_per_m,
                settings.stroke_m,
            ),
            false => 0.0,
        };
        // The smooth way has 1.5 times its mean velocity in the middle.
        let least_s = 3.0 * self.release_m.abs() / settings.velocity_m_per_s;
        self.duration_s = if settings.ramp_s > least_s {
            settings.ramp_s
        } else {
            least_s
        };
        self.phase = Phase::Ending;
        self.from_m = self.command_m;
        self.from_change_m = self.change_m;
        self.ending_s = 0.0;
    }

    /// Change of the command (m) in a tick of the end.
    fn ending_change(&mut self) -> f32 {
        self.ending_s += self.step_s;
        let share = self.ending_s / self.duration_s;
        let share = if share < 1.0 { share } else { 1.0 };
        if share == 1.0 {
            self.phase = Phase::Held;
        }
        let run_out = self.from_change_m / self.step_s * self.duration_s;
        let at = self.from_m
            + run_out * share * (1.0 - 0.5 * share)
            + self.release_m * share * share * (3.0 - 2.0 * share);
        at - self.command_m
    }
}

/// Number of ticks for which a condition has held without a break.
#[inline]
fn counted(holds: bool, so_far: u32) -> u32 {
    match holds {
        true => so_far.saturating_add(1),
        false => 0,
    }
}
