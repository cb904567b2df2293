//! Forces of the external dampers, tick by tick.

use std::time::Duration;

use super::force::set_force_n;
use super::line::Line;
use super::rig::RigLine;
use crate::commands::vehicle::drive::Exchange;
use dashpot_recording::ForceHistory;
use dashpot_vehicle_run::{Ending, Run, VehicleRunError};

/// Sources of the forces of the external dampers, tick by tick.
#[derive(Default)]
pub struct Lines {
    pub(super) lines: Vec<Line>,
    pub(super) recorded: Vec<(usize, ForceHistory)>,
    pub(super) rigs: Vec<RigLine>,
}

impl Lines {
    /// Creates the sources from links to targets, without recorded forces.
    pub fn new(lines: Vec<Line>) -> Self {
        Self {
            lines,
            recorded: Vec::new(),
            rigs: Vec::new(),
        }
    }

    /// Returns the links to targets.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// True if a damper is on a rig, real or virtual.
    pub fn has_rig(&self) -> bool {
        !self.rigs.is_empty()
    }

    /// True if a damper is behind a link or on a rig, and not only a recorded force.
    pub fn are_linked(&self) -> bool {
        self.has_rig() || !self.lines.is_empty()
    }

    /// Asks the guards of all rigs to bring their commands to rest. Does not allocate.
    pub fn request_end(&mut self) {
        self.rigs.iter_mut().for_each(RigLine::request_end);
    }
}

impl Exchange for Lines {
    /// Applies the recorded forces at the end of the coming tick.
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError> {
        let time_s = run.time_s() + run.vehicle().step_s();
        for (damper, history) in &self.recorded {
            let force_n = history.force_n(time_s);
            set_force_n(run, *damper, force_n)?;
        }
        Ok(())
    }

    /// Sends the displacements of the last tick; the returned forces act at the end of the next one. Returns an ending
    /// if a target is lost. Silent targets come last, because they use up the time that is left.
    fn after(&mut self, run: &mut Run, time_left: impl Fn() -> Duration) -> Option<Ending> {
        // A rig is never left out, because its actuator must not lose its command.
        let mut ended = None;
        for rig in &mut self.rigs {
            ended = rig.exchange(run).or(ended);
        }
        if ended.is_some() {
            return ended;
        }
        self.lines.iter_mut().for_each(Line::begin_tick);
        for comes_last in [false, true] {
            let mut lines = self.lines.iter_mut();
            let lost = lines.find_map(|line| {
                let is_due = line.comes_last() == comes_last;
                is_due.then(|| line.exchange(run, &time_left).err())?
            });
            if let Some(loss) = lost {
                return Some(run.outside_lost(*loss));
            }
        }
        None
    }
}
