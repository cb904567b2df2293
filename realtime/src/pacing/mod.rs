//! Real ticks at a fixed rate: absolute deadlines, so lateness does not add up.

mod apply;
mod clock;

pub use clock::{Clock, MonotonicClock, overhead_ns};

use crate::RealtimeError;
use crate::limits::{RATE_RANGE_HZ, TICKS_PER_ALLOWED_MISS};
use crate::options::RealtimeOptions;
use crate::timing::Distribution;

/// Ticks listed one by one after the start.
pub const FIRST_TICKS: usize = 8;

/// Paces the work of ticks: tick n is due n steps after tick 0.
///
/// No tick is left out: after an overrun the next ones start late, at once, until the work has caught
/// up. A tick misses its deadline when its work ends after the next tick is due.
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
    /// When tick 0 is or would have been due.
    origin_ns: Option<f64>,
    /// The tick that [`Self::release`] has begun.
    open: Option<TickTiming>,
    report: PacingReport,
}

/// When a tick was due and when its work began.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[must_use = "hand it to Pacer::finish after the work"]
pub struct TickTiming {
    /// Number of the tick.
    pub tick: u64,
    /// Due, on the pacer's clock (ns).
    pub due_ns: u64,
    /// Work began after it was due by (ns).
    pub late_ns: u64,
}

/// A tick whose work has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FinishedTick {
    /// From the work's begin to its end (ns).
    pub work_ns: u64,
    /// Whether the work ended before the next tick was due.
    pub met_deadline: bool,
}

/// What a pacer saw.
#[derive(Debug, Clone)]
pub struct PacingReport {
    /// Ticks finished.
    pub ticks: u64,
    /// Ticks whose work ended after the next tick was due.
    pub missed_deadlines: u64,
    /// From due to the work's begin (ns).
    pub lateness: Distribution,
    /// From the work's begin to its end, one clock reading within (ns).
    pub work: Distribution,
    /// From due to the work's end (ns).
    pub response: Distribution,
    /// Work of the first ticks, caches cold (ns).
    pub first_work_ns: Vec<u64>,
}

impl PacingReport {
    /// Whether the ticks were on time: at most one in [`TICKS_PER_ALLOWED_MISS`] missed its deadline.
    ///
    /// # Errors
    /// More missed.
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
    /// A pacer of `step_s` (s) on the system's clock, with the thread that calls it made real-time as
    /// `options` ask.
    ///
    /// # Errors
    /// The step is out of 100 us to 1 ms (10 to 1 kHz), or the system refuses an option.
    pub fn new(step_s: f64, options: &RealtimeOptions) -> Result<Self, RealtimeError> {
        let pacer = Self::with_clock(step_s, MonotonicClock::default())?;
        options.apply()?;
        Ok(pacer)
    }
}

impl<C: Clock> Pacer<C> {
    /// A pacer on a clock given.
    ///
    /// # Errors
    /// The step is out of 100 us to 1 ms.
    pub fn with_clock(step_s: f64, clock: C) -> Result<Self, RealtimeError> {
        let (shortest_s, longest_s) = (
            1.0 / f64::from(*RATE_RANGE_HZ.end()),
            1.0 / f64::from(*RATE_RANGE_HZ.start()),
        );
        // Half a nanosecond more either way: a step of 1/10000 s may be written in two ways.
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
            report: PacingReport {
                ticks: 0,
                missed_deadlines: 0,
                lateness: Distribution::new(),
                work: Distribution::new(),
                response: Distribution::new(),
                first_work_ns: Vec::with_capacity(FIRST_TICKS),
            },
        })
    }

    /// Sleeps until `tick` is due. The first call sets the time line: its tick is due a step later.
    pub fn wait(&mut self, tick: u64) -> TickTiming {
        let now_ns = self.clock.now_ns();
        self.wait_from(tick, now_ns)
    }

    fn wait_from(&mut self, tick: u64, now_ns: u64) -> TickTiming {
        let offset_ns = tick as f64 * self.step_ns;
        let origin_ns = *self
            .origin_ns
            .get_or_insert(now_ns as f64 + self.step_ns - offset_ns);
        // Exact to the nanosecond for 2^53 ns, a hundred days.
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

    /// Ends the work of the tick before, and sleeps until `tick` is due: the work of a tick is all that happens from its release to the
    /// next one, its booking included. In place of [`Self::wait`] and [`Self::finish`], with [`Self::end`] after the last tick.
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
        let timing = self.wait_from(tick, now_ns);
        self.open = Some(timing);
        if let Some(before) = before {
            self.book(before, now_ns);
        }
    }

    /// Ends the work of the tick that [`Self::release`] began, if one did.
    pub fn end(&mut self) {
        if let Some(open) = self.open.take() {
            let now_ns = self.clock.now_ns();
            self.book(open, now_ns);
        }
    }

    /// Ends the work of a tick and books it.
    pub fn finish(&mut self, timing: TickTiming) -> FinishedTick {
        let now_ns = self.clock.now_ns();
        self.book(timing, now_ns)
    }

    fn book(&mut self, timing: TickTiming, ended_ns: u64) -> FinishedTick {
        let response_ns = ended_ns.saturating_sub(timing.due_ns);
        let work_ns = response_ns.saturating_sub(timing.late_ns);
        let report = &mut self.report;
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

    /// What was seen so far.
    pub fn report(&self) -> &PacingReport {
        &self.report
    }

    /// What was seen, of a pacer that is done.
    pub fn into_report(self) -> PacingReport {
        self.report
    }

    /// Step (s).
    pub fn step_s(&self) -> f64 {
        self.step_ns * 1e-9
    }

    /// The clock.
    pub fn clock(&self) -> &C {
        &self.clock
    }
}
