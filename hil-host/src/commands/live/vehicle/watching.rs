//! Makes frames and rows from every tick, on a thread of its own.

use std::time::{Duration, Instant};

use dashpot_live::Observer;
use dashpot_realtime::handover::{Received, Receiver};
use dashpot_server::Hub;

use super::burst::Burst;
use super::control::Control;
use super::observed::Observed;
use super::tick::Tick;
use crate::commands::live::pace::{BURST, FRAME_S};
use crate::commands::live::rows::Rows;

/// Time to sleep if there is no tick.
const POLL: Duration = Duration::from_millis(1);

/// Where frames and rows go to.
pub(super) struct Watching<'a> {
    pub observer: Observer,
    /// The vehicle as new beside it.
    pub as_new: Option<AsNew>,
    pub hub: Hub,
    pub control: &'a Control,
    pub observed: &'a Observed,
    pub rows: Rows,
    pub step_s: f64,
}

/// The vehicle as new in one comparison.
pub(super) struct AsNew {
    comparison: u32,
    observer: Observer,
    flags: u32,
}

/// Frames that have not gone out yet.
struct Pending {
    burst: Burst,
    frame: FrameWork,
    burst_at: Instant,
}

/// Work of the ticks in a frame.
#[derive(Default)]
struct FrameWork {
    ticks: u64,
    sum_ns: u64,
    greatest_ns: u64,
    flags: u32,
}

impl Watching<'_> {
    /// Takes all ticks until the real-time thread has ended.
    pub fn run(mut self, ticks: &Receiver<Tick>) {
        let mut pending = Pending {
            burst: Burst::default(),
            frame: FrameWork::default(),
            burst_at: Instant::now(),
        };
        loop {
            match ticks.try_receive(|tick| self.add(tick, &mut pending)) {
                Received::Record => {}
                Received::Nothing => std::thread::sleep(POLL),
                Received::Ended => break,
            }
            let now = Instant::now();
            if now - pending.burst_at >= BURST {
                pending.burst_at = now;
                // A paused or slow run does not fill its frame.
                if pending.burst.is_empty() {
                    self.end_frame(&mut pending);
                }
                self.send_burst(&mut pending);
            }
            if self.rows.send_if_due(&self.observed.recording) {
                self.observed.read(&self.observer);
            }
        }
        self.end_frame(&mut pending);
        self.send_burst(&mut pending);
        self.rows.send(&self.observed.recording);
        self.observed.read(&self.observer);
    }

    fn add(&mut self, tick: &Tick, pending: &mut Pending) {
        if tick.epoch != self.rows.epoch() {
            self.begin(tick.epoch, pending);
        }
        if self
            .as_new
            .as_ref()
            .is_some_and(|as_new| as_new.comparison != tick.comparison)
        {
            self.as_new = None;
        }
        if tick.run > 0 {
            self.add_as_new(tick);
            return;
        }
        self.observer.add(tick.ticks, &tick.record);
        let frame = &mut pending.frame;
        frame.ticks += 1;
        frame.sum_ns += tick.work_ns;
        frame.greatest_ns = frame.greatest_ns.max(tick.work_ns);
        frame.flags |= tick.flags;
        // Faster than real time, a frame grows with the speed.
        let wanted_s = FRAME_S * self.control.factor().max(1.0);
        if frame.ticks as f64 * self.step_s >= wanted_s * (1.0 - 1e-9) {
            self.end_frame(pending);
        }
        // The first signal is the time, in single precision.
        let values = self.observer.values().get(1..).unwrap_or_default();
        let recording = &self.observed.recording;
        self.rows.add(tick.record.time_s, values, recording);
    }

    /// Takes a tick of the vehicle as new, which was the vehicle until the tick before its first.
    fn add_as_new(&mut self, tick: &Tick) {
        let as_new = self.as_new.get_or_insert_with(|| AsNew {
            comparison: tick.comparison,
            observer: self.observer.clone(),
            flags: 0,
        });
        as_new.observer.add(tick.ticks, &tick.record);
        as_new.flags |= tick.flags;
    }

    /// Begins with the first tick of another run.
    fn begin(&mut self, epoch: u32, pending: &mut Pending) {
        self.end_frame(pending);
        self.rows.begin(epoch, &self.observed.recording);
        self.as_new = None;
        if let Some(observer) = self.observed.take_next(epoch) {
            self.observer = observer;
        }
    }

    fn end_frame(&mut self, pending: &mut Pending) {
        let FrameWork {
            ticks,
            sum_ns,
            greatest_ns,
            flags,
        } = std::mem::take(&mut pending.frame);
        if ticks == 0 {
            return;
        }
        let work_us = [
            1e-3 * sum_ns as f32 / ticks as f32,
            1e-3 * greatest_ns as f32,
        ];
        let to = pending.burst.next();
        self.observer.frame(0, work_us, flags, to);
        if let Some(as_new) = &mut self.as_new {
            let to = pending.burst.next();
            as_new.observer.frame(1, [0.0; 2], as_new.flags, to);
        }
    }

    fn send_burst(&self, pending: &mut Pending) {
        self.hub.frames(pending.burst.take());
    }
}
