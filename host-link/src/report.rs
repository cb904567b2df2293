//! What a run found.

use dashpot_core::link::{Counters, Forces};
use serde::Serialize;

use super::LinkFaults;
use dashpot_realtime::pacing::PacingReport;
use dashpot_realtime::timing::{Distribution, Figures};

/// What a target said of itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Target {
    /// Version of its core.
    pub core_version: String,
    /// Dampers it holds.
    pub dampers: usize,
    /// Revision of each.
    pub revisions: Vec<u32>,
    /// Step of every damper (s).
    pub step_s: f32,
    /// Rate of the clock that measures its steps (Hz).
    pub clock_hz: u32,
}

/// Clock ticks or instructions of one tick of the bank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cost {
    /// Least.
    pub min: f64,
    /// Mean.
    pub mean: f64,
    /// Most.
    pub max: f64,
}

/// A force or status that is not the host's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mismatch {
    /// Tick, from 1.
    pub tick: u32,
    /// Damper, from 0.
    pub damper: usize,
    /// Force of the target (N).
    pub target_force_n: f32,
    /// Force of the host (N).
    pub host_force_n: f32,
    /// Status bits of the target.
    pub target_status: u16,
    /// Status bits of the host.
    pub host_status: u16,
}

/// How a paced run kept its time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pacing {
    /// Ticks answered after the next was due.
    pub missed_deadlines: u64,
    /// Their fraction of all ticks (1).
    pub missed_share: f64,
    /// From due to sent.
    pub lateness: Figures,
    /// From due to answered.
    pub response: Figures,
}

impl From<&PacingReport> for Pacing {
    fn from(seen: &PacingReport) -> Self {
        Self {
            missed_deadlines: seen.missed_deadlines,
            missed_share: seen.missed_deadlines as f64 / seen.ticks.max(1) as f64,
            lateness: seen.lateness.figures(),
            response: seen.response.figures(),
        }
    }
}

/// What a run found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The target.
    pub target: Target,
    /// Ticks stepped.
    pub ticks: u32,
    /// Forces and status words that differ from the host's, in bits.
    pub mismatches: u64,
    /// The first of them.
    pub first_mismatch: Option<Mismatch>,
    /// Dampers whose state at the end differs from the host's, in bits.
    pub state_mismatches: usize,
    /// From a step request to its answer, repetitions included.
    pub round_trip: Figures,
    /// Where ticks were sent when due.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pacing: Option<Pacing>,
    /// Clock ticks of the target that a step of the whole bank takes.
    pub clock_ticks: Cost,
    /// The same in instructions, where the link counts them.
    pub instructions: Option<Cost>,
    /// Times the target was given its dampers and states again.
    pub recoveries: u64,
    /// Faults the host noticed.
    pub link_faults: LinkFaults,
    /// The target's own counters, since it was last reset.
    pub target_counters: Counters,
}

/// What is measured tick by tick.
#[derive(Default)]
pub(super) struct Measured {
    pub(super) mismatches: u64,
    pub(super) first_mismatch: Option<Mismatch>,
    pub(super) round_trip: Distribution,
    pub(super) recoveries: u64,
    clock_ticks: u64,
    clock_range: Option<(u32, u32)>,
    steps: u64,
}

impl Measured {
    pub(super) fn clock(&mut self, forces: &Forces) {
        let taken = forces.clock_ticks;
        self.steps += 1;
        self.clock_ticks += u64::from(taken);
        let (least, most) = self.clock_range.unwrap_or((taken, taken));
        self.clock_range = Some((least.min(taken), most.max(taken)));
    }

    pub(super) fn mismatch(&mut self, mismatch: Mismatch) {
        self.mismatches += 1;
        self.first_mismatch.get_or_insert(mismatch);
    }

    pub(super) fn cost(&self) -> Cost {
        let (least, most) = self.clock_range.unwrap_or_default();
        Cost {
            min: f64::from(least),
            mean: self.clock_ticks as f64 / self.steps.max(1) as f64,
            max: f64::from(most),
        }
    }
}

impl Cost {
    pub(super) fn times(self, factor: f64) -> Self {
        Self {
            min: self.min * factor,
            mean: self.mean * factor,
            max: self.max * factor,
        }
    }
}
