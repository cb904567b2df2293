//! Makes frames and rows from every tick, on a thread of its own.

use std::time::{Duration, Instant};

use dashpot_live::Observer;
use dashpot_realtime::handover::{Received, Receiver};
use dashpot_server::Hub;

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
    pub hub: Hub,
    pub control: &'a Control,
    pub observed: &'a Observed,
    pub rows: Rows,
    pub step_s: f64,
}

/// Frames that have not gone out yet.
struct Pending {
    /// Frames of the burst; those behind `frame_count` are kept for their memory.
    frames: Vec<Vec<u8>>,
    frame_count: usize,
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
            frames: Vec::new(),
            frame_count: 0,
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
                if pending.frame_count == 0 {
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

    /// Begins with the first tick of another run.
    fn begin(&mut self, epoch: u32, pending: &mut Pending) {
        self.end_frame(pending);
        self.rows.begin(epoch, &self.observed.recording);
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
        if pending.frames.len() <= pending.frame_count {
            pending.frames.push(Vec::new());
        }
        let bytes = &mut pending.frames[pending.frame_count];
        self.observer.frame(0, work_us, flags, bytes);
        pending.frame_count += 1;
    }

    fn send_burst(&self, pending: &mut Pending) {
        let count = std::mem::take(&mut pending.frame_count);
        let frames = pending.frames[..count].iter();
        self.hub.frames(frames.map(Vec::as_slice));
    }
}
