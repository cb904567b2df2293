//! Work of the tick thread between two ticks: no allocations, and a constant number of instructions under Valgrind.
//!
//! Regression: on a quiet machine, `dashpot vehicle --realtime` was late by 1.4 to 11.7 ms at ticks 512, 1024, 2048 and
//! 4096, but reported 60 us. The tick thread enlarged and merged the curves of the page after it had taken the time of
//! the tick.

mod allocations;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod instructions;

use std::cell::{Cell, RefCell};

use dashpot_files::case::Case;
use dashpot_hil::commands::vehicle::drive::drive;
use dashpot_realtime::handover::handover;
use dashpot_realtime::pacing::{Clock, Pacer};
use dashpot_vehicle_run::{Ending, Run, TickRecord};

/// Simulated clock on which a tick takes 100 us. Each sleep is between two ticks, and calls `between`.
struct Ticks<F> {
    now_ns: Cell<u64>,
    between: RefCell<F>,
}

impl<F: FnMut()> Clock for Ticks<F> {
    fn now_ns(&self) -> u64 {
        self.now_ns.get()
    }

    fn sleep_until_ns(&self, deadline_ns: u64) {
        (self.between.borrow_mut())();
        self.now_ns.set(deadline_ns + 100_000);
    }
}

/// Drives `ticks` ticks of the locomotive at 180 km/h as the command does in real time, with a damper fault during the
/// run, and calls `between` before each tick. The records are read after the run, so that the thread does nothing else.
fn driven(ticks: u64, between: impl FnMut()) {
    let mut case = Case::load("straight-180").unwrap();
    case.duration_s = ticks as f64 * case.step_s;
    case.faults = vec![fault(&case)];
    let mut run = Run::new(&case).unwrap();
    let (giver, taker) = handover(vec![
        TickRecord::new(run.time_s(), run.state());
        ticks as usize
    ]);
    let clock = Ticks {
        now_ns: Cell::new(0),
        between: RefCell::new(between),
    };
    let mut pacer = Pacer::with_clock(case.step_s, clock).unwrap();
    let driven = drive(&mut run, &mut (), Some(&mut pacer), giver, || false).unwrap();
    assert_eq!(driven.ending, Ending::Completed);
    assert_eq!((driven.ticks, driven.waits), (ticks, 0));
    assert_eq!(pacer.report().ticks, ticks);
    let mut records = 0;
    while taker.receive(|_| records += 1) {}
    assert_eq!(records, ticks);
}

/// Returns a fault: the clearance of a damper changes to 4 mm after 200 ticks.
fn fault(case: &Case) -> dashpot_files::case::Fault {
    let (element, damper) = case
        .vehicle
        .elements
        .iter()
        .enumerate()
        .find(|(_, element)| element.name == "front lateral damper 1")
        .unwrap();
    let mut parameters = (*case.damper(&damper.name).unwrap()).clone();
    parameters.mount.clearance_m = 4e-3;
    dashpot_files::case::Fault {
        time_s: 0.2,
        damper: damper.name.clone(),
        element,
        parameters,
    }
}
