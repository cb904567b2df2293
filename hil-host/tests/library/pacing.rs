//! The pacer on a simulated clock.

use std::cell::Cell;

use dashpot_hil::realtime::pacing::{Clock, Pacer};

/// Time moves by sleeping, each sleep 5 us too long, and by hand.
struct SimulatedClock(Cell<u64>);

impl Clock for SimulatedClock {
    fn now_ns(&self) -> u64 {
        self.0.get()
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        self.0.set(deadline_ns + 5_000);
    }
}

#[test]
fn lateness_does_not_add_up_and_an_overrun_misses() {
    let mut pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    let mut late = Vec::new();
    for tick in 0..6 {
        let timing = pacer.wait(tick);
        assert_eq!(timing.due_ns, 700 + 1_000_000 * (tick + 1));
        late.push(timing.late_ns);
        // Tick 2 works for 2.5 ms, the others 100 us.
        let work = if tick == 2 { 2_500_000 } else { 100_000 };
        pacer.clock().0.set(pacer.clock().now_ns() + work);
        let finished = pacer.finish(timing);
        assert_eq!(finished.work_ns, work, "tick {tick}");
        let missed = tick == 2 || tick == 3;
        assert_eq!(finished.met_deadline, !missed, "tick {tick}");
    }
    // Tick 2 ends 2.505 ms after it was due: tick 3 begins 1.505 ms late, tick 4 0.605 ms.
    assert_eq!(late, [5_000, 5_000, 5_000, 1_505_000, 605_000, 5_000]);
    assert_eq!(pacer.report().missed_deadlines, 2);
    assert_eq!(pacer.report().first_work_ns[2], 2_500_000);
}

#[test]
fn rates_out_of_range_are_refused() {
    for step_s in [99e-6, 1.001e-3, f64::NAN] {
        let refusal = Pacer::with_clock(step_s, SimulatedClock(Cell::new(0)))
            .err()
            .unwrap();
        assert!(refusal.to_string().contains("100 to 1000 us"), "{refusal}");
    }
}
