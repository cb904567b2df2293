//! The work of the interrupt: one step of the bank.

use dashpot_core::{Damper, DamperState, Status, step_bank};
use dashpot_firmware::bank::DAMPERS;
use dashpot_firmware::board::{self, CLOCK_HZ};

use crate::{STEP_S, rig};

/// A sensor that fails for more ticks than this has failed for good: its damper has no force until it is back.
const MAX_BAD_TICKS: u32 = 20;

/// Faults and costs since the last report.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    /// Number of ticks since the start.
    pub tick: u32,
    /// Hash of the bits of all forces since the start.
    pub hash: u32,
    /// Status bits of all dampers.
    pub status: Status,
    /// Number of displacements that were not followed.
    pub rejected: u32,
    /// Number of ticks since the start that took longer than a period.
    pub late: u32,
    /// Clock ticks of the longest tick.
    pub cycles: u32,
    /// Forces of the last tick (N).
    pub forces_n: [f32; DAMPERS],
}

/// States of the bank, and what was not reported yet.
pub struct Tick {
    states: [DamperState<f32>; DAMPERS],
    bad_ticks: [u32; DAMPERS],
    is_stopped: bool,
    now: Report,
}

impl Tick {
    /// Every damper at rest at its displacement.
    pub fn start(bank: &[&Damper<f32>; DAMPERS]) -> Self {
        let displacements_m = rig::read(0);
        let mut states = [DamperState::default(); DAMPERS];
        for ((state, damper), displacement_m) in states.iter_mut().zip(bank).zip(displacements_m) {
            *state = damper.at_rest(displacement_m);
        }
        Self {
            states,
            bad_ticks: [0; DAMPERS],
            is_stopped: false,
            now: Report {
                tick: 0,
                hash: rig::HASH,
                status: Status::empty(),
                rejected: 0,
                late: 0,
                cycles: 0,
                forces_n: [0.0; DAMPERS],
            },
        }
    }

    /// Steps the bank and returns its forces (N).
    pub fn run(&mut self, bank: &[&Damper<f32>; DAMPERS]) -> [f32; DAMPERS] {
        let start = board::clock_now();
        let now = &mut self.now;
        now.tick = now.tick.wrapping_add(1);
        step_bank(
            bank,
            &mut self.states,
            &rig::read(now.tick),
            &mut now.forces_n,
        );
        self.handle_status();
        let now = &mut self.now;
        now.hash = rig::hash(now.hash, &now.forces_n);
        let cycles = board::clock_now().wrapping_sub(start);
        now.cycles = now.cycles.max(cycles);
        now.late += u32::from(cycles as f32 >= STEP_S * CLOCK_HZ as f32);
        now.forces_n
    }

    /// Number of ticks since the start.
    pub fn count(&self) -> u32 {
        self.now.tick
    }

    /// Takes the report.
    pub fn report(&mut self) -> Report {
        let report = self.now;
        self.now.status = Status::empty();
        self.now.rejected = 0;
        self.now.cycles = 0;
        report
    }

    /// Applies what the status bits of a tick mean for the forces.
    fn handle_status(&mut self) {
        let now = &mut self.now;
        let forces_n = now.forces_n.iter_mut();
        for ((state, bad_ticks), force_n) in self
            .states
            .iter_mut()
            .zip(&mut self.bad_ticks)
            .zip(forces_n)
        {
            let status = state.status();
            state.clear_status();
            now.status |= status;
            if status.intersects(Status::INPUT_HELD | Status::RESTARTED) {
                now.rejected += 1;
                *bad_ticks += 1;
            } else {
                *bad_ticks = 0;
            }
            if *bad_ticks > MAX_BAD_TICKS {
                *force_n = 0.0;
            }
            self.is_stopped |= status.contains(Status::CORRUPTED);
        }
        if self.is_stopped {
            now.forces_n = [0.0; DAMPERS];
        }
    }
}
