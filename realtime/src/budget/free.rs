//! A free run: one tick after another.

use super::{Length, Run, Series, stop};
use crate::pacing::{Clock, FIRST_TICKS};
use crate::timing::Distribution;

/// Ticks timed together, so that reading the clock costs each a hundredth of itself.
const BATCH: u64 = 100;

/// Times `tick` one by one, then in batches of a hundred; each pass has all the ticks of `length`, or half
/// its time, and counts them from 0. What two readings of the clock take, `overhead_ns`, is taken
/// off. A tick timed alone that takes longer than `stop_above_ns` ends the run.
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
    while stopped.is_none() && pass.goes_on() {
        let number = single.count();
        let elapsed_ns = pass.time(1, &mut tick);
        let work_ns = elapsed_ns.saturating_sub(overhead_ns) as f64;
        single.record_ns(work_ns);
        if first_ticks_ns.len() < FIRST_TICKS {
            first_ticks_ns.push(elapsed_ns);
        }
        stopped = stop(number, step_s, work_ns, stop_above_ns);
    }
    let mut pass = Pass::new(clock, length);
    while stopped.is_none() && pass.goes_on() {
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

    /// Whether ticks or time are left; the first tick always runs.
    fn goes_on(&self) -> bool {
        match self.length {
            Length::Ticks(ticks) => self.ticks < ticks,
            Length::Nanoseconds(run_ns) => {
                self.ticks == 0 || self.now_ns - self.begin_ns < run_ns / 2
            }
        }
    }

    /// Runs `ticks` ticks; from before to after them (ns).
    fn time(&mut self, ticks: u64, tick: &mut impl FnMut()) -> u64 {
        let before_ns = self.clock.now_ns();
        (0..ticks).for_each(|_| tick());
        self.now_ns = self.clock.now_ns();
        self.ticks += ticks;
        self.now_ns - before_ns
    }
}
