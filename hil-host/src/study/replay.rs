//! Recorded motion on the tick grid, through the step.

use dashpot_core::{Damper, DamperState, Real, Status};

use crate::files::FileError;
use crate::files::recording::{MOST_TICKS, Recording, RecordingError, Sample};
use crate::realtime::pacing::Pacer;

/// One tick of a replay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Time (s), first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement there (m), linear between samples.
    pub displacement_m: f64,
}

/// The tick grid of a recording: starts at its first sample, ends within its last.
pub struct TickGrid {
    recording: Recording,
    step_s: f64,
    start_s: f64,
    number: u64,
    before: Sample,
    after: Sample,
}

/// How far a sample meant for the tick at `time_s` (s) of steps of `step_s` (s) may lie from it by
/// rounding (s).
pub(crate) fn rounding_s(time_s: f64, step_s: f64) -> f64 {
    1e-9 * step_s + 4.0 * f64::EPSILON * time_s.abs()
}

impl TickGrid {
    /// The grid of `step_s` (s) over `recording`.
    ///
    /// # Errors
    /// No readable row.
    pub fn new(mut recording: Recording, step_s: f64) -> Result<Self, FileError> {
        let first = recording
            .next_sample()?
            .ok_or_else(|| recording.in_text(RecordingError::NoRow { left_out: 0 }))?;
        Ok(Self {
            recording,
            step_s,
            start_s: first.time_s,
            number: 0,
            before: first,
            after: first,
        })
    }

    /// The next tick; `None` past the last sample.
    ///
    /// # Errors
    /// A row that cannot be read, or a recording over 24 hours of 10 kHz ticks long.
    pub fn next_tick(&mut self) -> Result<Option<Tick>, FileError> {
        let offset_s = self.number as f64 * self.step_s;
        let time_s = self.start_s + offset_s;
        // A sample meant for a tick may lie a rounding before it.
        let slack_s = rounding_s(time_s, self.step_s);
        while self.after.time_s + slack_s < time_s {
            let Some(next) = self.recording.next_sample()? else {
                return Ok(None);
            };
            if (next.time_s - self.start_s) / self.step_s > MOST_TICKS {
                let time_s = next.time_s;
                return Err(self.recording.in_time(RecordingError::TooLong { time_s }));
            }
            self.before = self.after;
            self.after = next;
        }
        self.number += 1;
        let (before, after) = (self.before, self.after);
        let displacement_m = if time_s + slack_s >= after.time_s {
            after.displacement_m
        } else {
            let fraction = (time_s - before.time_s) / (after.time_s - before.time_s);
            before.displacement_m + fraction * (after.displacement_m - before.displacement_m)
        };
        Ok(Some(Tick {
            time_s,
            displacement_m,
        }))
    }

    /// All ticks left.
    ///
    /// # Errors
    /// As [`TickGrid::next_tick`].
    pub fn read_all(mut self) -> Result<Vec<Tick>, FileError> {
        let mut ticks = Vec::new();
        while let Some(tick) = self.next_tick()? {
            ticks.push(tick);
        }
        Ok(ticks)
    }

    /// Displacements (m) at all ticks left.
    ///
    /// # Errors
    /// As [`TickGrid::next_tick`].
    pub fn displacements_m(self) -> Result<Vec<f64>, FileError> {
        let ticks = self.read_all()?;
        Ok(ticks.iter().map(|tick| tick.displacement_m).collect())
    }

    /// Time of the first tick (s).
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// The recording, read up to the last tick.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }
}

/// What a replay did. Force and energy are of the motion that the damper followed: where the recorded
/// displacement was held or limited, not the recorded one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Ticks stepped.
    pub ticks: u64,
    /// Root mean square of the force (N).
    pub force_rms_n: f64,
    /// Largest force in extension (N).
    pub max_extension_force_n: f64,
    /// Largest force in compression (N), positive.
    pub max_compression_force_n: f64,
    /// Energy taken from the motion, `integral F dx` by the trapezoidal rule (J).
    pub energy_j: f64,
    /// Ticks whose displacement was not finite in the step's precision, so that the one before was held.
    pub held_inputs: u64,
    /// Ticks whose displacement moved faster than the damper's limit and was followed at that rate.
    pub limited_inputs: u64,
    /// Time of the first tick held or limited (s).
    pub first_rejected_s: Option<f64>,
    /// Ticks at the saturation force or force limit.
    pub saturated_ticks: u64,
}

impl Summary {
    /// Books the status of the tick at `time_s` (s) alone.
    fn book(&mut self, time_s: f64, status: Status) {
        let held = status.contains(Status::INPUT_HELD);
        let limited = status.contains(Status::INPUT_LIMITED);
        self.held_inputs += u64::from(held);
        self.limited_inputs += u64::from(limited);
        self.saturated_ticks += u64::from(status.contains(Status::SATURATED));
        if held || limited {
            self.first_rejected_s.get_or_insert(time_s);
        }
    }
}

/// Steps `damper` over `ticks`, in real ticks where there is a pacer, and hands each tick with its force
/// (N) to `sink`. Reading and writing happen in the slack of the ticks.
///
/// # Errors
/// What `ticks` or `sink` return.
pub fn replay<T: Real, E: From<FileError>>(
    damper: &Damper<T>,
    ticks: &mut TickGrid,
    mut pacer: Option<&mut Pacer>,
    mut sink: impl FnMut(Tick, T, &TickGrid) -> Result<(), E>,
) -> Result<Summary, E> {
    let mut state: Option<DamperState<T>> = None;
    let mut last: Option<(f64, f64)> = None;
    let mut summary = Summary::default();
    let (mut square, mut lowest) = (0.0, 0.0_f64);
    while let Some(tick) = ticks.next_tick()? {
        let displacement = T::from_f64(tick.displacement_m);
        let state = state.get_or_insert_with(|| damper.at_rest(displacement));
        let timing = pacer.as_mut().map(|pacer| pacer.wait(summary.ticks));
        let force = damper.step(state, displacement);
        if let (Some(pacer), Some(timing)) = (pacer.as_mut(), timing) {
            pacer.finish(timing);
        }
        sink(tick, force, ticks)?;
        summary.book(tick.time_s, state.status());
        state.clear_status();
        let (followed, force) = (state.displacement_m().to_f64(), force.to_f64());
        if let Some((x, f)) = last {
            summary.energy_j += 0.5 * (force + f) * (followed - x);
        }
        last = Some((followed, force));
        summary.ticks += 1;
        square += force * force;
        summary.max_extension_force_n = summary.max_extension_force_n.max(force);
        lowest = lowest.min(force);
    }
    summary.force_rms_n = (square / summary.ticks.max(1) as f64).sqrt();
    // A sum, so that no compression is 0 and not -0.
    summary.max_compression_force_n = 0.0 - lowest;
    Ok(summary)
}
