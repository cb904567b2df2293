//! Report of a run.

use dashpot_core::link::{Counters, Forces};
use serde::Serialize;

use super::LinkFaults;
use dashpot_realtime::pacing::PacingReport;
use dashpot_realtime::timing::{Distribution, Figures};

/// Description of a target, as the target reports it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Target {
    /// Version of its core.
    pub core_version: String,
    /// Number of dampers.
    pub dampers: usize,
    /// Revision of each damper.
    pub revisions: Vec<u32>,
    /// Step of all dampers (s).
    pub step_s: f32,
    /// Frequency of the clock that measures the steps (Hz).
    pub clock_hz: u32,
}

/// Clock ticks or instructions per tick of the bank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cost {
    /// Minimum.
    pub min: f64,
    /// Mean.
    pub mean: f64,
    /// Maximum.
    pub max: f64,
}

/// A force or status that differs between target and host.
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

/// Timing of a paced run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pacing {
    /// Number of ticks answered after the next tick was due.
    pub missed_deadlines: u64,
    /// Fraction of ticks that missed their deadline (1).
    pub missed_share: f64,
    /// Time from when a tick is due to when it is sent.
    pub lateness: Figures,
    /// Time from when a tick is due to when it is answered.
    pub response: Figures,
}

impl From<&PacingReport> for Pacing {
    fn from(report: &PacingReport) -> Self {
        Self {
            missed_deadlines: report.missed_deadlines,
            missed_share: report.missed_deadlines as f64 / report.ticks.max(1) as f64,
            lateness: report.lateness.figures(),
            response: report.response.figures(),
        }
    }
}

/// Report of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Target.
    pub target: Target,
    /// Number of ticks.
    pub ticks: u32,
    /// Number of forces and status words whose bits differ from those of the host.
    pub mismatches: u64,
    /// First mismatch.
    pub first_mismatch: Option<Mismatch>,
    /// Number of dampers whose final state differs from that of the host, compared bit by bit.
    pub state_mismatches: usize,
    /// Time from a step request to its answer, including repetitions.
    pub round_trip: Figures,
    /// Timing, if the run was paced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pacing: Option<Pacing>,
    /// Clock ticks of the target per step of the whole bank.
    pub clock_ticks: Cost,
    /// Instructions per step of the whole bank, if the link counts them.
    pub instructions: Option<Cost>,
    /// Number of times the host sent the dampers and states to the target again.
    pub recoveries: u64,
    /// Faults that the host detected.
    pub link_faults: LinkFaults,
    /// Counters of the target since its last reset.
    pub target_counters: Counters,
}

/// Measurements accumulated over the ticks.
#[derive(Default)]
pub(super) struct Measured {
    pub(super) mismatches: u64,
    pub(super) first_mismatch: Option<Mismatch>,
    pub(super) round_trip: Distribution,
    pub(super) recoveries: u64,
    clock_ticks: u64,
    /// Minimum and maximum.
    clock_range: Option<(u32, u32)>,
    steps: u64,
}

impl Measured {
    pub(super) fn clock(&mut self, forces: &Forces) {
        let taken = forces.clock_ticks;
        self.steps += 1;
        self.clock_ticks += u64::from(taken);
        let (min, max) = self.clock_range.unwrap_or((taken, taken));
        self.clock_range = Some((min.min(taken), max.max(taken)));
    }

    pub(super) fn mismatch(&mut self, mismatch: Mismatch) {
        self.mismatches += 1;
        self.first_mismatch.get_or_insert(mismatch);
    }

    pub(super) fn cost(&self) -> Cost {
        let (min, max) = self.clock_range.unwrap_or_default();
        Cost {
            min: f64::from(min),
            mean: self.clock_ticks as f64 / self.steps.max(1) as f64,
            max: f64::from(max),
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
