//! Replay of a recorded motion through a damper.

use dashpot_core::{Damper, DamperState, Status};

use crate::compiled::Compiled;

use dashpot_files::FileError;
use dashpot_realtime::pacing::Pacer;
use dashpot_recording::tick_grid::{Tick, TickGrid};

/// Summary of a replay.
///
/// Force and energy belong to the motion that the damper actually followed, which differs from the recording where the
/// displacement was held or rate-limited.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Number of ticks stepped.
    pub ticks: u64,
    /// Root mean square force (N).
    pub force_rms_n: f64,
    /// Maximum force in extension (N).
    pub max_extension_force_n: f64,
    /// Maximum force in compression (N), as a magnitude.
    pub max_compression_force_n: f64,
    /// Energy dissipated, `integral F dx` by the trapezoidal rule (J).
    pub energy_j: f64,
    /// Ticks that kept the previous displacement, because the new one was not finite in the step's precision, out of
    /// range or too far away.
    pub held_inputs: u64,
    /// Ticks whose displacement moved faster than the damper's rate limit and was followed at that rate.
    pub limited_inputs: u64,
    /// Ticks whose displacement was too far away to catch up with; the damper restarted there at rest.
    pub restarts: u64,
    /// Time of the first tick that was held, limited or restarted (s).
    pub first_rejected_s: Option<f64>,
    /// Ticks at the saturation force or the force limit.
    pub saturated_ticks: u64,
}

impl Summary {
    /// Counts the status bits of the tick at `time_s` (s).
    fn count(&mut self, time_s: f64, status: Status) {
        let held = status.contains(Status::INPUT_HELD);
        let limited = status.contains(Status::INPUT_LIMITED);
        self.held_inputs += u64::from(held);
        self.limited_inputs += u64::from(limited);
        let restarted = status.contains(Status::RESTARTED);
        self.restarts += u64::from(restarted);
        self.saturated_ticks += u64::from(status.contains(Status::SATURATED));
        if held || limited || restarted {
            self.first_rejected_s.get_or_insert(time_s);
        }
    }
}

/// Steps `damper` through `ticks`, in real time if there is a `pacer`, and passes each tick and its force (N) to
/// `sink`.
///
/// Reading and writing happen within the ticks and are timed with them: the work of a tick is everything between its
/// release and the next.
///
/// # Errors
/// Returns the errors of `ticks` and `sink`.
pub fn replay<T: Compiled, E: From<FileError>>(
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
        if let Some(pacer) = &mut pacer {
            pacer.release(summary.ticks);
        }
        let force = T::compiled_step(damper, state, displacement);
        sink(tick, force, ticks)?;
        let status = state.status();
        summary.count(tick.time_s, status);
        state.clear_status();
        let (followed, force) = (state.displacement_m().to_f64(), force.to_f64());
        // A restart is not a motion and dissipates no energy.
        let moved = last.filter(|_| !status.contains(Status::RESTARTED));
        if let Some((x, f)) = moved {
            summary.energy_j += 0.5 * (force + f) * (followed - x);
        }
        last = Some((followed, force));
        summary.ticks += 1;
        square += force * force;
        summary.max_extension_force_n = summary.max_extension_force_n.max(force);
        lowest = lowest.min(force);
    }
    if let Some(pacer) = pacer {
        pacer.end();
    }
    summary.force_rms_n = (square / summary.ticks.max(1) as f64).sqrt();
    // A subtraction gives 0 for no compression; a negation would give -0.
    summary.max_compression_force_n = 0.0 - lowest;
    Ok(summary)
}
