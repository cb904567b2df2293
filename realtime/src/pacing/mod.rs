//! Paces ticks at a fixed rate in real time. Deadlines are absolute, so lateness does not accumulate.

mod apply;
mod clock;

pub use clock::{Clock, MonotonicClock, overhead_ns};

use std::time::Duration;

use crate::RealtimeError;
use crate::limits::{RATE_RANGE_HZ, TICKS_PER_ALLOWED_MISS};
use crate::options::RealtimeOptions;
use crate::stop::Stop;
use crate::timing::Distribution;

/// Number of first ticks that are reported one by one.
pub const FIRST_TICKS: usize = 8;

/// Paces the work of ticks: tick n is due n steps after tick 0.
///
/// No tick is skipped: after an overrun, the next ticks start immediately until the work has caught up. A tick misses
/// its deadline if its work ends after the next tick is due.
///
/// ```
/// use dashpot_realtime::pacing::Pacer;
/// use dashpot_realtime::options::RealtimeOptions;
/// let mut pacer = Pacer::new(1e-3, &RealtimeOptions::default())?;
/// for tick in 0..5 {
///     let timing = pacer.wait(tick);
///     // the work of the tick
///     pacer.finish(timing);
/// }
/// assert_eq!(pacer.report().ticks, 5);
/// # Ok::<(), dashpot_realtime::RealtimeError>(())
/// ```
pub struct Pacer<C: Clock = MonotonicClock> {
    clock: C,
    step_ns: f64,
    /// Due time of tick 0, even if the run started with a later tick.
    origin_ns: Option<f64>,
    /// Tick that [`Self::release`] has started.
    open: Option<TickTiming>,
    /// Longest allowed work of a tick (ns).
    stop_above_ns: Option<u64>,
    report: PacingReport,
}

/// Times at which a tick was due and its work started.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[must_use = "pass it to Pacer::finish after the work"]
pub struct TickTiming {
    /// Number of the tick.
    pub tick: u64,
    /// Time at which the tick was due on the clock of the pacer (ns).
    pub due_ns: u64,
    /// Delay from the due time to the start of the work (ns).
    pub late_ns: u64,
}

impl TickTiming {
    /// Duration of work that ended at `ended_ns` (ns).
    fn work_ns(&self, ended_ns: u64) -> u64 {
        ended_ns
            .saturating_sub(self.due_ns)
            .saturating_sub(self.late_ns)
    }
}

/// Result of a tick after its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FinishedTick {
    /// Duration of the work (ns).
    pub work_ns: u64,
    /// True if the work ended before the next tick was due.
    pub met_deadline: bool,
}

/// Statistics of a pacer.
#[derive(Debug, Clone)]
pub struct PacingReport {
    /// Number of finished ticks.
    pub ticks: u64,
    /// Number of ticks whose work ended after the next tick was due.
    pub missed_deadlines: u64,
    /// First tick whose work took longer than the limit of [`Pacer::stopping_above_ns`].
    pub stopped: Option<Stop>,
    /// Time from the due time of a tick to the start of its work (ns).
    pub lateness: Distribution,
    /// Duration of the work, including one clock reading (ns).
    pub work: Distribution,
    /// Time from the due time of a tick to the end of its work (ns).
    pub response: Distribution,
    /// Durations of the work of the first ticks, with cold caches (ns).
    pub first_work_ns: Vec<u64>,
}

impl PacingReport {
    /// Checks that at most one tick in [`TICKS_PER_ALLOWED_MISS`] missed its deadline.
    ///
    /// # Errors
    /// More ticks missed their deadlines.
    pub fn verdict(&self) -> Result<(), RealtimeError> {
        let Self {
            ticks,
            missed_deadlines: missed,
            ..
        } = *self;
        if missed.saturating_mul(TICKS_PER_ALLOWED_MISS) > ticks {
            return Err(RealtimeError::TooManyMissed { missed, ticks });
        }
        Ok(())
    }
}

impl Pacer<MonotonicClock> {
    /// Creates a pacer with a step of `step_s` (s) on the clock of the system, and applies `options` to the calling
    /// thread.
    ///
    /// # Errors
    /// The step is outside 100 us to 1 ms (10 to 1 kHz), or the system refuses an option.
    pub fn new(step_s: f64, options: &RealtimeOptions) -> Result<Self, RealtimeError> {
        let pacer = Self::with_clock(step_s, MonotonicClock::default())?;
        options.apply()?;
        Ok(pacer)
    }
}

impl<C: Clock> Pacer<C> {
    /// Creates a pacer with a step of `step_s` (s) on the given clock.
    ///
    /// # Errors
    /// The step is outside 100 us to 1 ms.
    pub fn with_clock(step_s: f64, clock: C) -> Result<Self, RealtimeError> {
        let (shortest_s, longest_s) = (
            1.0 / f64::from(*RATE_RANGE_HZ.end()),
            1.0 / f64::from(*RATE_RANGE_HZ.start()),
        );
        // A tolerance of half a nanosecond accepts rounded steps such as 1/10000 s.
        if !(shortest_s - 5e-10..=longest_s + 5e-10).contains(&step_s) {
            return Err(RealtimeError::Step {
                step_us: step_s * 1e6,
            });
        }
        Ok(Self {
            clock,
            step_ns: step_s * 1e9,
            origin_ns: None,
            open: None,
            stop_above_ns: None,
            report: PacingReport {
                ticks: 0,
                missed_deadlines: 0,
                stopped: None,
                lateness: Distribution::new(),
                work: Distribution::new(),
                response: Distribution::new(),
                first_work_ns: Vec::with_capacity(FIRST_TICKS),
            },
        })
    }

    /// Sets the longest allowed work of a tick (ns); `None`, the default, allows any. The first tick that takes longer
    /// is [`PacingReport::stopped`]; the caller then ends the run.
    #[must_use]
    pub fn stopping_above_ns(mut self, limit_ns: Option<u64>) -> Self {
        self.stop_above_ns = limit_ns;
        self
    }

    /// Time until the deadline of the tick that [`Self::release`] started; zero after the deadline or without a tick.
    ///
    /// ```
    /// use dashpot_realtime::pacing::Pacer;
    /// use dashpot_realtime::options::RealtimeOptions;
    /// use std::time::Duration;
    /// let mut pacer = Pacer::new(1e-3, &RealtimeOptions::default())?;
    /// assert_eq!(pacer.time_left(), Duration::ZERO);
    /// pacer.release(0);
    /// assert!(pacer.time_left() < Duration::from_millis(1));
    /// # Ok::<(), dashpot_realtime::RealtimeError>(())
    /// ```
    pub fn time_left(&self) -> Duration {
        let Some(open) = self.open else {
            return Duration::ZERO;
        };
        let deadline_ns = open.due_ns + self.step_ns.round() as u64;
        Duration::from_nanos(deadline_ns.saturating_sub(self.clock.now_ns()))
    }

    /// Sleeps until `tick` is due. The first call starts the schedule: its tick is due one step later.
    pub fn wait(&mut self, tick: u64) -> TickTiming {
        let now_ns = self.clock.now_ns();
        self.wait_from(tick, now_ns)
    }

    fn wait_from(&mut self, tick: u64, now_ns: u64) -> TickTiming {
        let offset_ns = tick as f64 * self.step_ns;
        let origin_ns = *self
            .origin_ns
            .get_or_insert(now_ns as f64 + self.step_ns - offset_ns);
        // Exact to the nanosecond for 2^53 ns, about a hundred days.
        let due_ns = (origin_ns + offset_ns).round() as u64;
        if now_ns < due_ns {
            self.clock.sleep_until_ns(due_ns);
        }
        TickTiming {
            tick,
            due_ns,
            late_ns: self.clock.now_ns().saturating_sub(due_ns),
        }
    }

    /// Ends the work of the previous tick and sleeps until `tick` is due. With this method, the work of a tick is
    /// everything between two releases, including the statistics. Use this instead of [`Self::wait`] and
    /// [`Self::finish`], and call [`Self::end`] after the last tick. If the work of the previous tick took longer than
    /// the limit, this neither sleeps nor starts `tick`: check [`PacingReport::stopped`].
    ///
    /// ```
    /// use dashpot_realtime::pacing::Pacer;
    /// use dashpot_realtime::options::RealtimeOptions;
    /// let mut pacer = Pacer::new(1e-3, &RealtimeOptions::default())?;
    /// for tick in 0..5 {
    ///     pacer.release(tick);
    ///     // the work of the tick
    /// }
    /// pacer.end();
    /// assert_eq!(pacer.report().ticks, 5);
    /// # Ok::<(), dashpot_realtime::RealtimeError>(())
    /// ```
    pub fn release(&mut self, tick: u64) {
        let now_ns = self.clock.now_ns();
        let before = self.open.take();
        if let Some(slow) = before.filter(|timing| self.is_too_slow(*timing, now_ns)) {
            self.record(slow, now_ns);
            return;
        }
        let timing = self.wait_from(tick, now_ns);
        self.open = Some(timing);
        if let Some(before) = before {
            self.record(before, now_ns);
        }
    }

    /// Ends the work of the tick that [`Self::release`] started, if there is one.
    pub fn end(&mut self) {
        if let Some(open) = self.open.take() {
            let now_ns = self.clock.now_ns();
            self.record(open, now_ns);
        }
    }

    /// Ends the work of a tick and records it.
    pub fn finish(&mut self, timing: TickTiming) -> FinishedTick {
        let now_ns = self.clock.now_ns();
        self.record(timing, now_ns)
    }

    /// True if the work of a tick that ends at `ended_ns` took longer than the limit.
    fn is_too_slow(&self, timing: TickTiming, ended_ns: u64) -> bool {
        self.stop(timing, ended_ns).is_some()
    }

    /// The stop of a run whose tick ends at `ended_ns`, if its work took longer than the limit.
    fn stop(&self, timing: TickTiming, ended_ns: u64) -> Option<Stop> {
        let work_ns = timing.work_ns(ended_ns) as f64;
        Stop::if_above(timing.tick, self.step_s(), work_ns, self.stop_above_ns)
    }

    fn record(&mut self, timing: TickTiming, ended_ns: u64) -> FinishedTick {
        let response_ns = ended_ns.saturating_sub(timing.due_ns);
        let work_ns = timing.work_ns(ended_ns);
        let stop = self.stop(timing, ended_ns);
        let report = &mut self.report;
        report.stopped = report.stopped.or(stop);
        if report.first_work_ns.len() < FIRST_TICKS {
            report.first_work_ns.push(work_ns);
        }
        let met_deadline = response_ns as f64 <= self.step_ns;
        report.ticks += 1;
        report.missed_deadlines += u64::from(!met_deadline);
        report.lateness.record_ns(timing.late_ns as f64);
        report.work.record_ns(work_ns as f64);
        report.response.record_ns(response_ns as f64);
        FinishedTick {
            work_ns,
            met_deadline,
        }
    }

    /// Statistics so far.
    pub fn report(&self) -> &PacingReport {
        &self.report
    }

    /// Returns the statistics after the last tick.
    pub fn into_report(self) -> PacingReport {
        self.report
    }

    /// Step (s).
    pub fn step_s(&self) -> f64 {
        self.step_ns * 1e-9
    }

    /// Returns the clock.
    pub fn clock(&self) -> &C {
        &self.clock
    }
}
