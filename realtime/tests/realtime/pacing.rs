//! The pacer on a simulated clock.

use std::cell::Cell;
use std::time::Duration;

use dashpot_realtime::RealtimeError;
use dashpot_realtime::budget::Run;
use dashpot_realtime::pacing::{Clock, Pacer};

/// A clock that the tests advance. Each sleep is 5 us too long.
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
fn lateness_does_not_accumulate_and_overruns_miss_deadlines() {
    let mut pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    let mut late = Vec::new();
    for tick in 0..6 {
        let timing = pacer.wait(tick);
        assert_eq!(timing.due_ns, 700 + 1_000_000 * (tick + 1));
        late.push(timing.late_ns);
        // The work of tick 2 takes 2.5 ms, that of the others 100 us.
        let work = if tick == 2 { 2_500_000 } else { 100_000 };
        pacer.clock().0.set(pacer.clock().now_ns() + work);
        let finished = pacer.finish(timing);
        assert_eq!(finished.work_ns, work, "tick {tick}");
        let missed = tick == 2 || tick == 3;
        assert_eq!(finished.met_deadline, !missed, "tick {tick}");
    }
    // Tick 2 ends 2.505 ms after it was due, so tick 3 starts 1.505 ms late and tick 4 0.605 ms late.
    assert_eq!(late, [5_000, 5_000, 5_000, 1_505_000, 605_000, 5_000]);
    assert_eq!(pacer.report().missed_deadlines, 2);
    assert_eq!(pacer.report().first_work_ns[2], 2_500_000);
}

/// Regression test: work after `finish` was not counted, so a tick of 11.7 ms was reported as 60 us.
#[test]
fn work_between_two_releases_is_counted() {
    let mut pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    for tick in 0..6 {
        pacer.release(tick);
        // The work of tick 2 takes 2.5 ms, that of the others 100 us.
        let work = if tick == 2 { 2_500_000 } else { 100_000 };
        pacer.clock().0.set(pacer.clock().now_ns() + work);
    }
    assert_eq!(pacer.report().ticks, 5);
    pacer.end();
    pacer.end();
    let report = pacer.report();
    assert_eq!((report.ticks, report.missed_deadlines), (6, 2));
    assert_eq!(report.work.figures().worst_ns, 2_500_000.0);
    assert_eq!(report.work.figures().worst_index, 2);
    assert_eq!(
        report.first_work_ns,
        [100_000, 100_000, 2_500_000, 100_000, 100_000, 100_000]
    );
}

#[test]
fn one_deadline_in_a_thousand_may_be_missed() {
    for (ticks, missed, is_on_time) in [
        (10_000, 10, true),
        (10_000, 11, false),
        (999, 0, true),
        (999, 1, false),
        (1000, 1, true),
    ] {
        let mut pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
        for tick in 0..ticks {
            pacer.release(tick);
            // Work that lasts one step and starts 5 us late misses only the deadline of its own tick.
            let work = if tick < missed { 1_000_000 } else { 1000 };
            pacer.clock().0.set(pacer.clock().now_ns() + work);
        }
        pacer.end();
        assert_eq!(pacer.report().missed_deadlines, missed);
        let verdict = pacer.report().verdict();
        assert_eq!(verdict.is_ok(), is_on_time, "{missed} of {ticks}");
        if let Err(error) = verdict {
            let expected = format!("{missed} of {ticks} deadlines missed; allowed: one in 1000");
            assert_eq!(error.to_string(), expected);
        }
    }
}

#[test]
fn rates_out_of_range_are_rejected() {
    for step_s in [99e-6, 1.001e-3, f64::NAN] {
        let error = Pacer::with_clock(step_s, SimulatedClock(Cell::new(0)))
            .err()
            .unwrap();
        assert!(error.to_string().contains("100 to 1000 us"), "{error}");
    }
}

/// The run ends at once: no sleep and no further tick after the slow one.
#[test]
fn the_first_tick_above_the_limit_is_reported_and_none_follows() {
    let pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    let mut pacer = pacer.stopping_above_ns(Some(100_000));
    let mut released = 0;
    for tick in 0..6 {
        pacer.release(tick);
        if pacer.report().stopped.is_some() {
            break;
        }
        released += 1;
        // The work of tick 2 takes 2.5 ms; that of the others, 100 us, is exactly the limit.
        let work = if tick == 2 { 2_500_000 } else { 100_000 };
        pacer.clock().0.set(pacer.clock().now_ns() + work);
    }
    // Tick 2 was due at 3 ms and 700 ns and started 5 us late.
    let ended_ns = 3_000_700 + 5_000 + 2_500_000;
    assert_eq!(pacer.clock().now_ns(), ended_ns);
    pacer.end();
    let report = pacer.into_report();
    assert_eq!((released, report.ticks), (3, 3));
    let stop = report.stopped.unwrap();
    assert_eq!(
        (stop.tick, stop.work_ns, stop.limit_ns),
        (2, 2.5e6, 100_000)
    );
    assert!((stop.time_s - 2e-3).abs() < 1e-15);
    let run = Run::from(report);
    assert_eq!((run.ticks, run.missed_deadlines), (3, Some(1)));
    assert!(matches!(run.verdict(false), Err(RealtimeError::Stopped(_))));
}

#[test]
fn a_slow_last_tick_is_reported_too() {
    let pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    let mut pacer = pacer.stopping_above_ns(Some(100_000));
    pacer.release(0);
    pacer.clock().0.set(pacer.clock().now_ns() + 100_001);
    pacer.end();
    assert_eq!(pacer.report().stopped.unwrap().tick, 0);
}

#[test]
fn the_time_left_ends_when_the_next_tick_is_due() {
    let mut pacer = Pacer::with_clock(1e-3, SimulatedClock(Cell::new(700))).unwrap();
    assert_eq!(pacer.time_left(), Duration::ZERO);
    pacer.release(0);
    // Each sleep is 5 us too long.
    assert_eq!(pacer.time_left(), Duration::from_micros(995));
    pacer.clock().0.set(pacer.clock().now_ns() + 900_000);
    assert_eq!(pacer.time_left(), Duration::from_micros(95));
    pacer.clock().0.set(pacer.clock().now_ns() + 900_000);
    assert_eq!(pacer.time_left(), Duration::ZERO);
    pacer.end();
    assert_eq!(pacer.time_left(), Duration::ZERO);
}
