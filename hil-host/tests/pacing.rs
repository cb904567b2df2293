//! The pacer on a clock that tells what it is told, and percentiles beside sorted samples.

use std::cell::Cell;

use dashpot_hil::pacing::{Clock, Pacer};
use dashpot_hil::timing::Distribution;

/// Time moves by sleeping, each sleep 5 us too long, and by hand.
struct Told(Cell<u64>);

impl Clock for Told {
    fn now_ns(&self) -> u64 {
        self.0.get()
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        self.0.set(deadline_ns + 5_000);
    }
}

#[test]
fn lateness_does_not_add_up_and_an_overrun_misses() {
    let mut pacer = Pacer::with_clock(1e-3, Told(Cell::new(700))).unwrap();
    let mut late = Vec::new();
    for tick in 0..6 {
        let timing = pacer.wait(tick);
        assert_eq!(timing.due_ns, 700 + 1_000_000 * (tick + 1));
        late.push(timing.late_ns);
        // Tick 2 works for 2.5 ms, the others 100 us.
        let work = if tick == 2 { 2_500_000 } else { 100_000 };
        pacer.clock().0.set(pacer.clock().now_ns() + work);
        let met = pacer.finish(timing);
        assert_eq!(met, !(tick == 2 || tick == 3), "tick {tick}");
    }
    // Tick 2 ends 2.505 ms after it was due: tick 3 begins 1.505 ms late, tick 4 0.605 ms.
    assert_eq!(late, [5_000, 5_000, 5_000, 1_505_000, 605_000, 5_000]);
    assert_eq!(pacer.report().missed_deadlines, 2);
    assert_eq!(pacer.report().first_work_ns[2], 2_500_000);
}

#[test]
fn rates_out_of_range_are_refused() {
    for step_s in [99e-6, 1.001e-3, f64::NAN] {
        let refusal = Pacer::with_clock(step_s, Told(Cell::new(0))).err().unwrap();
        assert!(refusal.to_string().contains("100 to 1000 us"), "{refusal}");
    }
}

#[test]
fn percentiles_are_those_of_the_sorted_samples() {
    let mut distribution = Distribution::new();
    let mut samples = Vec::new();
    let mut seed = 1_u64;
    for _ in 0..50_000 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let span = 10.0 + ((seed >> 40) as f64).sqrt();
        distribution.record_ns(span);
        samples.push(span);
    }
    samples.sort_by(f64::total_cmp);
    let figures = distribution.figures();
    for (share, found) in [
        (0.5, figures.p50_ns),
        (0.9, figures.p90_ns),
        (0.99, figures.p99_ns),
        (0.999, figures.p99_9_ns),
        (0.9999, figures.p99_99_ns),
    ] {
        let expected = samples[(share * 50_000.0_f64).ceil() as usize - 1];
        // Three significant digits.
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{share}: {found} {expected}"
        );
    }
    let bars = distribution.bars(16);
    assert_eq!(bars.iter().map(|bar| bar.count).sum::<u64>(), 50_000);
}
