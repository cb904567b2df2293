//! Commands that do not arrive.

use dashpot_core::hybrid::wire::{Frame, FrameFlags};

/// How a rig bridges commands that do not arrive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeeperSettings {
    /// Ticks in a row for which the command goes on at its last rate.
    pub extrapolated_ticks: u32,
    /// Time in which it then comes to rest (s).
    pub ramp_s: f64,
    /// Largest rate of the command (m/s).
    pub velocity_m_per_s: f64,
    /// Largest magnitude of the command (m).
    pub stroke_m: f64,
}

/// Gives the actuator a command in every tick: the newest that arrived, its extrapolation, and then a ramp to a hold.
///
/// The hold lasts until the next session. No command ever moves faster than the velocity limit.
#[derive(Clone, Debug)]
pub struct CommandKeeper {
    settings: KeeperSettings,
    step_s: f64,
    command_m: f64,
    rate_m_per_s: f64,
    missed: u32,
    /// True after the first command without the flag `START`: before, a vehicle that builds its model may be silent.
    is_watched: bool,
    /// Rate at the beginning of the ramp, and its ticks so far.
    ramp: Option<(f64, u32)>,
    longest_gap: u32,
}

impl CommandKeeper {
    /// A keeper at rest at a displacement (m), for ticks of `step_s`.
    pub fn new(settings: KeeperSettings, displacement_m: f64, step_s: f64) -> Self {
        Self {
            settings,
            step_s,
            command_m: displacement_m,
            rate_m_per_s: 0.0,
            missed: 0,
            is_watched: false,
            ramp: None,
            longest_gap: 0,
        }
    }

    /// Starts again at the present command.
    pub fn restart(&mut self) {
        (self.rate_m_per_s, self.missed, self.ramp) = (0.0, 0, None);
        self.is_watched = false;
    }

    /// Takes the newest command of a tick, or none; returns the command for the actuator (m).
    pub fn tick(&mut self, newest: Option<&Frame>) -> f64 {
        let limit = self.settings.velocity_m_per_s;
        self.missed = match newest {
            None if self.is_watched => self.missed.saturating_add(1),
            _ => 0,
        };
        self.longest_gap = self.longest_gap.max(self.missed);
        let is_stop = newest.is_some_and(|frame| frame.flags.contains(FrameFlags::STOP));
        // After the end of a session, silence is no gap.
        self.is_watched &= !is_stop;
        let wanted_m = match (self.ramp, newest) {
            // A vehicle that has no answer yet does not know where the rig is.
            (None, Some(frame)) if !is_stop && frame.answers == 0 => self.command_m,
            (None, Some(frame)) if !is_stop => {
                self.is_watched |= !frame.flags.contains(FrameFlags::START);
                self.rate_m_per_s = f64::from(frame.other).clamp(-limit, limit);
                f64::from(frame.displacement_m)
            }
            (None, None) if !self.is_watched => self.command_m,
            (None, _) => {
                if is_stop || self.missed > self.settings.extrapolated_ticks {
                    self.ramp = Some((self.rate_m_per_s, 0));
                }
                self.command_m + self.ramped_rate() * self.step_s
            }
            (Some(_), _) => self.command_m + self.ramped_rate() * self.step_s,
        };
        let most_m = limit * self.step_s;
        let stroke_m = self.settings.stroke_m;
        let reachable_m = wanted_m.clamp(self.command_m - most_m, self.command_m + most_m);
        self.command_m = reachable_m.clamp(-stroke_m, stroke_m);
        self.command_m
    }

    /// The last rate, falling evenly to zero once the ramp has begun.
    fn ramped_rate(&mut self) -> f64 {
        let Some((from, ticks)) = &mut self.ramp else {
            return self.rate_m_per_s;
        };
        *ticks = ticks.saturating_add(1);
        let share = f64::from(*ticks) * self.step_s / self.settings.ramp_s;
        *from * (1.0 - share).max(0.0)
    }

    /// The command of the last tick (m).
    pub fn command_m(&self) -> f64 {
        self.command_m
    }

    /// True if the rig follows no command until the next session.
    pub fn is_held(&self) -> bool {
        self.ramp.is_some()
    }

    /// True if the command of a held rig has come to rest.
    pub fn is_at_rest(&self) -> bool {
        let past_s = |ticks: u32| f64::from(ticks) * self.step_s;
        self.ramp
            .is_some_and(|(_, ticks)| past_s(ticks) >= self.settings.ramp_s)
    }

    /// Largest number of ticks in a row without a command.
    pub fn longest_gap(&self) -> u32 {
        self.longest_gap
    }
}
