//! The last ticks of the bank, which a host reads for one damper at a time.

use super::limits::MAX_SAMPLES;
use super::lists::Sample;
use super::message::Response;
use super::refusal::Refusal;
use crate::state::DamperState;
use crate::status::Status;

/// Number of ticks kept for [`Request::Telemetry`](super::Request::Telemetry). It is a power of two, so that the ring
/// stays in order when the count of ticks wraps.
pub const KEPT_TICKS: usize = 64;

/// One tick of the bank.
#[derive(Clone, Copy, Debug)]
struct Tick<const N: usize> {
    tick: u32,
    displacements_m: [f32; N],
    forces_n: [f32; N],
    status: [Status; N],
}

/// A ring of ticks, from which each damper is read separately.
#[derive(Debug)]
pub(crate) struct Recorder<const N: usize> {
    ticks: [Tick<N>; KEPT_TICKS],
    /// Number of recorded ticks, wrapping. Modulo the length of the ring it is the index of the next tick.
    recorded: u32,
    kept: u32,
    /// Number of recorded ticks that were taken or missed, for each damper.
    taken: [u32; N],
    overwritten: [u32; N],
}

impl<const N: usize> Recorder<N> {
    pub(crate) const fn new() -> Self {
        Self {
            ticks: [Tick {
                tick: 0,
                displacements_m: [0.0; N],
                forces_n: [0.0; N],
                status: [Status::empty(); N],
            }; KEPT_TICKS],
            recorded: 0,
            kept: 0,
            taken: [0; N],
            overwritten: [0; N],
        }
    }

    pub(crate) fn record(&mut self, tick: u32, states: &[DamperState<f32>; N]) {
        self.ticks[self.recorded as usize % KEPT_TICKS] = Tick {
            tick,
            displacements_m: states.each_ref().map(DamperState::displacement_m),
            forces_n: states.each_ref().map(DamperState::force_n),
            status: states.each_ref().map(DamperState::status),
        };
        self.recorded = self.recorded.wrapping_add(1);
        self.kept = (self.kept + 1).min(KEPT_TICKS as u32);
    }

    /// Takes the oldest samples of a damper that were not yet taken.
    pub(crate) fn take(&mut self, damper: u8) -> Result<Response<'static>, Refusal> {
        let index = usize::from(damper);
        let reader = self
            .taken
            .get_mut(index)
            .zip(self.overwritten.get_mut(index));
        let (taken, overwritten) = reader.ok_or(Refusal::Damper(N as u8))?;
        let missed = self.recorded.wrapping_sub(*taken).saturating_sub(self.kept);
        *overwritten = overwritten.saturating_add(missed);
        *taken = taken.wrapping_add(missed);
        let waiting = self.recorded.wrapping_sub(*taken);
        let count = waiting.min(MAX_SAMPLES as u32);
        let samples = (0..count).filter_map(|sample| {
            let recorded = &self.ticks[taken.wrapping_add(sample) as usize % KEPT_TICKS];
            Some(Sample {
                tick: recorded.tick,
                displacement_m: *recorded.displacements_m.get(index)?,
                force_n: *recorded.forces_n.get(index)?,
                status: recorded.status.get(index)?.bits(),
            })
        });
        let samples = samples.collect();
        *taken = taken.wrapping_add(count);
        Ok(Response::Telemetry {
            overwritten: *overwritten,
            samples,
        })
    }
}
