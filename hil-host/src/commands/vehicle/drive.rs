//! Stepping loop of a run, in real time or as fast as possible. Its thread does nothing else.

use std::time::{Duration, Instant};

use dashpot_realtime::handover::Sender;
use dashpot_realtime::pacing::{Clock, Pacer};
use dashpot_vehicle_run::{Ending, Run, TickRecord, VehicleRunError};

/// Exchange of a tick with external dampers.
pub trait Exchange {
    /// Sets the forces that act at the end of the next tick.
    ///
    /// # Errors
    /// A force is not finite.
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError>;
    /// Sends the displacements of the tick and sets the returned forces. Returns an ending if a damper is lost.
    /// `time_left` returns the time until the deadline of the tick; it is zero if the run is not paced.
    fn after(&mut self, run: &mut Run, time_left: impl Fn() -> Duration) -> Option<Ending>;
}

/// No external dampers.
impl Exchange for () {
    fn before(&mut self, _: &mut Run) -> Result<(), VehicleRunError> {
        Ok(())
    }
    fn after(&mut self, _: &mut Run, _: impl Fn() -> Duration) -> Option<Ending> {
        None
    }
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Driven {
    /// Ending of the run.
    pub ending: Ending,
    /// Number of ticks.
    pub ticks: u64,
    /// Time spent in the steps of the vehicle, without exchange and reporting.
    pub stepping: Duration,
    /// Number of ticks that waited for a free record because the reading thread had fallen behind.
    pub waits: u64,
}

/// Steps `run` to its end, paced if there is a `pacer`, and sends a record of each tick to another thread. The run ends
/// early after a tick whose work took longer than the limit of the pacer.
///
/// A tick allocates nothing and makes no system calls except those of `exchange` and the clocks. The pacer times all of
/// this as the work of the tick.
///
/// # Errors
/// Errors from [`Exchange::before`] and [`Run::step`].
pub fn drive<C: Clock>(
    run: &mut Run,
    exchange: &mut impl Exchange,
    mut pacer: Option<&mut Pacer<C>>,
    mut records: Sender<TickRecord>,
    is_unwanted: impl Fn() -> bool,
) -> Result<Driven, VehicleRunError> {
    let mut driven = Driven {
        ending: Ending::Completed,
        ticks: 0,
        stepping: Duration::ZERO,
        waits: 0,
    };
    while !run.is_over() {
        if let Some(pacer) = &mut pacer {
            pacer.release(driven.ticks);
            if let Some(stop) = pacer.report().stopped {
                driven.ending = run.slow_tick(stop.tick, stop.work_ns, stop.limit_ns);
                break;
            }
        }
        exchange.before(run)?;
        let started = Instant::now();
        let stepped = run.step()?;
        driven.stepping += started.elapsed();
        driven.ticks += 1;
        let time_left = || pacer.as_deref().map_or(Duration::ZERO, Pacer::time_left);
        let ended = stepped.or_else(|| exchange.after(run, time_left));
        // If the reading thread has ended, it reports its own error.
        let is_read = records
            .send(|record| record.copy(run.time_s(), run.state()))
            .is_ok();
        if let Some(ending) = ended {
            driven.ending = ending;
            break;
        }
        if !is_read || is_unwanted() {
            driven.ending = run.interrupted();
            break;
        }
    }
    if let Some(pacer) = pacer {
        pacer.end();
    }
    driven.waits = records.waits();
    Ok(driven)
}
