//! Recorded motion on the tick grid, through the step.

use dashpot_core::{Damper, DamperState, Real, Status};

use crate::failure::{Failure, Outcome};
use crate::pacing::Pacer;
use crate::recording::{Recording, Sample};

/// One tick of a replay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Time (s), first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement there (m), linear between samples.
    pub displacement_m: f64,
}

/// The tick grid of a recording: starts at its first sample, ends within its last.
pub struct Ticks {
    recording: Recording,
    step_s: f64,
    start_s: f64,
    number: u64,
    before: Sample,
    after: Sample,
}

/// Ticks a recording may span: 24 hours at 10 kHz, so that one mistyped time does not fill a disk.
const MOST_TICKS: f64 = 864e6;

impl Ticks {
    /// The grid of `step_s` (s) over `recording`.
    ///
    /// # Errors
    /// No readable row.
    pub fn new(mut recording: Recording, step_s: f64) -> Outcome<Self> {
        let first = recording
            .next_sample()?
            .ok_or_else(|| Failure::new("a recording has no row"))?;
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
    pub fn next_tick(&mut self) -> Outcome<Option<Tick>> {
        let offset_s = self.number as f64 * self.step_s;
        let time_s = self.start_s + offset_s;
        // A sample meant for a tick may lie a rounding before it.
        let slack = 1e-9 * self.step_s + 4.0 * f64::EPSILON * time_s.abs();
        while self.after.time_s + slack < time_s {
            let Some(next) = self.recording.next_sample()? else {
                return Ok(None);
            };
            if (next.time_s - self.start_s) / self.step_s > MOST_TICKS {
                return Err(self.recording.in_time(format!(
                    "{} s is more than {MOST_TICKS} ticks after the first sample; split the recording \
                     or take a larger step",
                    next.time_s
                )));
            }
            self.before = self.after;
            self.after = next;
        }
        self.number += 1;
        let span = self.after.time_s - self.before.time_s;
        let share = if span > 0.0 {
            ((time_s - self.before.time_s) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let (from, to) = (self.before.displacement_m, self.after.displacement_m);
        Ok(Some(Tick {
            time_s,
            displacement_m: from + share * (to - from),
        }))
    }

    /// Displacements (m) at all ticks left.
    ///
    /// # Errors
    /// As [`Ticks::next_tick`].
    pub fn displacements_m(mut self) -> Outcome<Vec<f64>> {
        let mut displacements_m = Vec::new();
        while let Some(tick) = self.next_tick()? {
            displacements_m.push(tick.displacement_m);
        }
        Ok(displacements_m)
    }

    /// Bytes of the recording read so far.
    pub fn position(&self) -> u64 {
        self.recording.position()
    }
}

/// What a replay did.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Latched status bits.
    pub status: Status,
    /// Ticks whose displacement was held or limited, up to 65535.
    pub rejected_inputs: u16,
}

/// Steps `damper` over `ticks`, in real ticks where there is a pacer, and hands each tick with its force
/// (N) to `sink`. Reading and writing happen in the slack of the ticks.
///
/// # Errors
/// What `ticks` or `sink` return.
pub fn replay<T: Real>(
    damper: &Damper<T>,
    ticks: &mut Ticks,
    mut pacer: Option<&mut Pacer>,
    mut sink: impl FnMut(Tick, T, &Ticks) -> Outcome<()>,
) -> Outcome<Summary> {
    let mut state: Option<DamperState<T>> = None;
    let mut last: Option<(f64, f64)> = None;
    let (mut count, mut square, mut energy) = (0_u64, 0.0, 0.0);
    let (mut highest, mut lowest) = (0.0_f64, 0.0_f64);
    while let Some(tick) = ticks.next_tick()? {
        let displacement = T::from_f64(tick.displacement_m);
        let state = state.get_or_insert_with(|| damper.at_rest(displacement));
        let timing = pacer.as_mut().map(|pacer| pacer.wait(count));
        let force = damper.step(state, displacement);
        if let (Some(pacer), Some(timing)) = (pacer.as_mut(), timing) {
            pacer.finish(timing);
        }
        sink(tick, force, ticks)?;
        let force = force.to_f64();
        if let Some((x, f)) = last {
            energy += 0.5 * (force + f) * (tick.displacement_m - x);
        }
        last = Some((tick.displacement_m, force));
        count += 1;
        square += force * force;
        highest = highest.max(force);
        lowest = lowest.min(force);
    }
    Ok(Summary {
        ticks: count,
        force_rms_n: (square / count.max(1) as f64).sqrt(),
        max_extension_force_n: highest,
        max_compression_force_n: 0.0 - lowest,
        energy_j: energy,
        status: state.as_ref().map_or(Status::empty(), DamperState::status),
        rejected_inputs: state.as_ref().map_or(0, DamperState::rejected_inputs),
    })
}
