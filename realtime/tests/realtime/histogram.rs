//! The histogram of a paced run on a simulated clock, as text in the layout of cyclictest.

use std::cell::Cell;

use dashpot_realtime::budget::{Length, histogram, paced};
use dashpot_realtime::pacing::{Clock, Pacer};

/// A clock that the ticks advance. Sleep number n ends n times 1.5 us late, the fifth 12 ms late.
struct SimulatedClock<'a> {
    now_ns: &'a Cell<u64>,
    sleeps: Cell<u64>,
}

impl Clock for SimulatedClock<'_> {
    fn now_ns(&self) -> u64 {
        self.now_ns.get()
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        let sleep = self.sleeps.get();
        self.sleeps.set(sleep + 1);
        let late_ns = if sleep == 4 { 12_000_000 } else { 1500 * sleep };
        self.now_ns.set(deadline_ns + late_ns);
    }
}

fn text(ticks: u64) -> String {
    let now_ns = Cell::new(0);
    let clock = SimulatedClock {
        now_ns: &now_ns,
        sleeps: Cell::new(0),
    };
    let pacer = Pacer::with_clock(1e-3, clock).unwrap();
    let work = || now_ns.set(now_ns.get() + 2_999);
    histogram(&paced(pacer, Length::Ticks(ticks), None, work))
}

#[test]
fn each_tick_is_counted_in_its_microsecond() {
    // Lateness 0, 1.5, 3 and 4.5 us; work 2.999 us.
    let expected = "# Histogram\n\
                    # Columns: us work lateness response\n\
                    000000 000000\t000001\t000000\n\
                    000001 000000\t000001\t000000\n\
                    000002 000004\t000000\t000001\n\
                    000003 000000\t000001\t000000\n\
                    000004 000000\t000001\t000001\n\
                    000005 000000\t000000\t000001\n\
                    000006 000000\t000000\t000000\n\
                    000007 000000\t000000\t000001\n\
                    # Total: 000000004\t000000004\t000000004\n\
                    # Min Latencies: 00002\t00000\t00002\n\
                    # Avg Latencies: 00002\t00002\t00005\n\
                    # Max Latencies: 00002\t00004\t00007\n\
                    # Histogram Overflows: 00000\t00000\t00000\n";
    assert_eq!(text(4), expected);
}

#[test]
fn a_tick_later_than_the_last_line_is_an_overflow() {
    let text = text(5);
    // The other columns of the line are those of the four ticks before.
    assert!(
        text.contains("# Total: 000000005\t000000004\t000000004\n"),
        "{text}"
    );
    assert!(
        text.contains("# Max Latencies: 00002\t12000\t12002\n"),
        "{text}"
    );
    assert!(
        text.contains("# Histogram Overflows: 00000\t00001\t00001\n"),
        "{text}"
    );
}

#[test]
fn a_run_without_ticks_has_no_lines() {
    let lines = text(0);
    assert!(lines.lines().all(|line| line.starts_with('#')), "{lines}");
    assert!(
        lines.contains("# Total: 000000000\t000000000\t000000000\n"),
        "{lines}"
    );
}
