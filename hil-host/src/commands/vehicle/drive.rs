//! The ticks of a run, in real time or as fast as they go: the thread that steps does nothing else.

use std::time::{Duration, Instant};

use dashpot_realtime::handover::Sender;
use dashpot_realtime::pacing::{Clock, Pacer};
use dashpot_vehicle_run::{Ending, Run, TickRecord, VehicleRunError};

/// What a tick exchanges with dampers outside the vehicle.
pub trait Exchange {
    /// Sets forces that act at the end of the tick to come.
    ///
    /// # Errors
    /// A force that is not finite.
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError>;
    /// Sends what the tick has moved and sets the forces that come back; how the run ended, where a damper is lost.
    fn after(&mut self, run: &mut Run) -> Option<Ending>;
}

/// All dampers are inside.
impl Exchange for () {
    fn before(&mut self, _: &mut Run) -> Result<(), VehicleRunError> {
        Ok(())
    }
    fn after(&mut self, _: &mut Run) -> Option<Ending> {
        None
    }
}

/// What became of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Driven {
    /// How it ended.
    pub ending: Ending,
    /// Ticks taken.
    pub ticks: u64,
    /// Time that the steps of the vehicle took, without exchange and report.
    pub stepping: Duration,
    /// Ticks that waited for a free record, because the thread that reads them had fallen behind.
    pub waits: u64,
}

/// Takes the ticks of `run`, at those of `pacer` where there is one, and hands a record of each to another thread. A
/// tick allocates
/// nothing and calls nothing of the system but for what `exchange` and the clocks do, and all of it is within the work
/// that the pacer times.
///
/// # Errors
/// As [`Exchange::before`] and [`Run::step`].
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
        }
        exchange.before(run)?;
        let started = Instant::now();
        let stepped = run.step()?;
        driven.stepping += started.elapsed();
        driven.ticks += 1;
        let ended = stepped.or_else(|| exchange.after(run));
        // A thread that ended has met an error, which it reports.
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
