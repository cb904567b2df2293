//! Timing of a free run: each tick starts when the previous one ends.

use super::{Length, Run, Series};
use crate::pacing::{Clock, FIRST_TICKS};
use crate::stop::Stop;
use crate::timing::Distribution;

/// Number of ticks per batch, so that each tick carries only a hundredth of the cost of reading the clock.
const BATCH: u64 = 100;

/// Times `tick` in two passes: first each tick alone, then batches of a hundred ticks. Each pass runs all ticks of
/// `length`, or half its time. `overhead_ns`, the cost of two clock readings, is subtracted from all results except the
/// durations of the first ticks. The run ends when a single tick takes longer than `stop_above_ns`.
pub fn free(
    clock: &impl Clock,
    overhead_ns: u64,
    step_s: f64,
    length: Length,
    stop_above_ns: Option<u64>,
    mut tick: impl FnMut(),
) -> Run {
    let mut first_ticks_ns = Vec::new();
    let mut stopped = None;
    let (mut single, mut batched) = (Distribution::new(), Distribution::new());
    let mut pass = Pass::new(clock, length);
    while stopped.is_none() && pass.has_ticks_left() {
        let number = single.count();
        let elapsed_ns = pass.time(1, &mut tick);
        let work_ns = elapsed_ns.saturating_sub(overhead_ns) as f64;
        single.record_ns(work_ns);
        if first_ticks_ns.len() < FIRST_TICKS {
            first_ticks_ns.push(elapsed_ns);
        }
        stopped = Stop::if_above(number, step_s, work_ns, stop_above_ns);
    }
    let mut pass = Pass::new(clock, length);
    while stopped.is_none() && pass.has_ticks_left() {
        let work_ns = pass.time(BATCH, &mut tick).saturating_sub(overhead_ns);
        batched.record_ns(work_ns as f64 / BATCH as f64);
    }
    let ticks = single.count();
    let series = [("batched", BATCH, batched), ("single", 1, single)];
    Run {
        ticks,
        missed_deadlines: None,
        stopped,
        first_ticks_ns,
        series: series
            .into_iter()
            .filter(|(_, _, spans)| spans.count() > 0)
            .map(|(name, ticks_per_span, spans)| Series {
                name,
                ticks_per_span,
                spans,
            })
            .collect(),
    }
}

/// One of the two passes.
struct Pass<'a, C> {
    clock: &'a C,
    length: Length,
    begin_ns: u64,
    now_ns: u64,
    ticks: u64,
}

impl<'a, C: Clock> Pass<'a, C> {
    fn new(clock: &'a C, length: Length) -> Self {
        let now_ns = clock.now_ns();
        Self {
            clock,
            length,
            begin_ns: now_ns,
            now_ns,
            ticks: 0,
        }
    }

    /// True if ticks or time are left. With a time limit, always true before the first tick.
    fn has_ticks_left(&self) -> bool {
        match self.length {
            Length::Ticks(ticks) => self.ticks < ticks,
            Length::Nanoseconds(run_ns) => {
                self.ticks == 0 || self.now_ns - self.begin_ns < run_ns / 2
            }
        }
    }

    /// Runs `ticks` ticks and returns their duration (ns).
    fn time(&mut self, ticks: u64, tick: &mut impl FnMut()) -> u64 {
        let before_ns = self.clock.now_ns();
        (0..ticks).for_each(|_| tick());
        self.now_ns = self.clock.now_ns();
        self.ticks += ticks;
        self.now_ns - before_ns
    }
}
