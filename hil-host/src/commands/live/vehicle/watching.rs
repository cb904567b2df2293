//! Makes frames and rows from every tick, on a thread of its own.

use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use dashpot_live::Observer;
use dashpot_realtime::handover::{Received, Receiver};
use dashpot_server::Hub;

use super::control::Control;
use super::observed::Observed;
use super::tick::Tick;
use crate::commands::live::recorder::{Block, GrowingMdf};

/// Simulated time of a frame, s, so that loops are smooth. Faster than real time it grows with the speed.
const FRAME_S: f64 = 0.005;

/// Time between two bursts of frames: a browser draws 60 times a second.
const BURST: Duration = Duration::from_micros(16_667);

/// Most rows between two writes: what a killed process loses.
const BLOCK_ROWS: u64 = 200;

/// Time between two writes.
const BLOCK: Duration = Duration::from_millis(100);

/// Time to sleep if there is no tick.
const POLL: Duration = Duration::from_millis(1);

/// Where frames and rows go to.
pub(super) struct Watching<'a> {
    pub observer: Observer,
    pub hub: Hub,
    pub control: &'a Control,
    pub observed: &'a Observed,
    /// `None` without a recording.
    pub blocks: Option<SyncSender<Block>>,
    pub step_s: f64,
}

/// Frames and rows that have not gone out yet.
struct Pending {
    epoch: u32,
    /// Frames of the burst; those behind `frame_count` are kept for their memory.
    frames: Vec<Vec<u8>>,
    frame_count: usize,
    frame: FrameWork,
    block: Vec<u8>,
    rows: u64,
    burst_at: Instant,
    block_at: Instant,
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
        let now = Instant::now();
        let mut pending = Pending {
            epoch: 1,
            frames: Vec::new(),
            frame_count: 0,
            frame: FrameWork::default(),
            block: Vec::new(),
            rows: 0,
            burst_at: now,
            block_at: now,
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
            if now - pending.block_at >= BLOCK {
                pending.block_at = now;
                self.send_block(&mut pending);
                self.observed.read(&self.observer);
            }
        }
        self.end_frame(&mut pending);
        self.send_burst(&mut pending);
        self.send_block(&mut pending);
        self.observed.read(&self.observer);
    }

    fn add(&mut self, tick: &Tick, pending: &mut Pending) {
        if tick.epoch != pending.epoch {
            self.begin(tick.epoch, pending);
        }
        self.observer.add(tick.ticks, &tick.record);
        let frame = &mut pending.frame;
        frame.ticks += 1;
        frame.sum_ns += tick.work_ns;
        frame.greatest_ns = frame.greatest_ns.max(tick.work_ns);
        frame.flags |= tick.flags;
        let wanted_s = FRAME_S * self.control.factor().max(1.0);
        if frame.ticks as f64 * self.step_s >= wanted_s * (1.0 - 1e-9) {
            self.end_frame(pending);
        }
        if self.blocks.is_some() && self.observed.recording.is_on() {
            let time_s = crate::commands::nearest_nanosecond(tick.record.time_s);
            // The first signal is the time, in single precision.
            let values = self.observer.values().get(1..).unwrap_or_default();
            GrowingMdf::add_row(time_s, values, &mut pending.block);
            pending.rows += 1;
            if pending.rows >= BLOCK_ROWS {
                self.send_block(pending);
            }
        }
    }

    /// Begins with the first tick of another run.
    fn begin(&mut self, epoch: u32, pending: &mut Pending) {
        self.end_frame(pending);
        self.send_block(pending);
        pending.epoch = epoch;
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

    fn send_block(&self, pending: &mut Pending) {
        let rows = std::mem::take(&mut pending.rows);
        let bytes = std::mem::take(&mut pending.block);
        let Some(blocks) = self.blocks.as_ref().filter(|_| rows > 0) else {
            return;
        };
        let block = Block {
            epoch: pending.epoch,
            rows,
            bytes,
        };
        if blocks.try_send(block).is_err() {
            self.observed.recording.leave_out(rows);
        }
    }
}
