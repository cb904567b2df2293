//! Frames for viewers and rows for the recording, from the samples of a target.

use std::sync::Arc;
use std::time::Instant;

use dashpot_live::{Frame, FrameHead, flags};
use dashpot_server::Hub;

use crate::commands::live::pace::{BURST, FRAME_S};
use crate::commands::live::recorded::RecordingState;
use crate::commands::live::rows::Rows;

/// Names of the signals of a target with this number of dampers, the time first.
pub(super) fn names(dampers: usize) -> Vec<String> {
    let of = |slot| {
        ["displacement_m", "force_n", "model_force_n"].map(|name| format!("slot_{slot}_{name}"))
    };
    std::iter::once("time_s".to_owned())
        .chain((0..dampers).flat_map(of))
        .collect()
}

/// Where the samples of a target go.
pub(super) struct Tap {
    hub: Hub,
    recording: Arc<RecordingState>,
    rows: Rows,
    step_s: f64,
    frame: Frame,
    work: [f32; 2],
    flags: u32,
    frames: Vec<Vec<u8>>,
    burst_at: Instant,
    /// First and last tick of the present file.
    ticks: Option<[u32; 2]>,
}

impl Tap {
    pub fn new(
        hub: Hub,
        recording: Arc<RecordingState>,
        rows: Rows,
        (step_s, signals): (f64, usize),
    ) -> Self {
        Self {
            hub,
            recording,
            rows,
            step_s,
            frame: Frame::new(signals),
            work: [0.0; 2],
            flags: 0,
            frames: Vec::new(),
            burst_at: Instant::now(),
            ticks: None,
        }
    }

    /// Takes the values of a tick, without the time. A tick that is not behind the last begins another file.
    pub fn add(&mut self, tick: u32, values: &[f32], work_us: f32, is_late: bool) {
        let start = match self.ticks {
            Some([start, last]) if tick > last => start,
            Some(_) => {
                self.end_frame();
                self.rows.begin(self.rows.epoch() + 1, &self.recording);
                tick
            }
            None => tick,
        };
        self.ticks = Some([start, tick]);
        let time_s = f64::from(tick - start) * self.step_s;
        self.frame
            .add(std::iter::once(time_s as f32).chain(values.iter().copied()));
        self.work = [self.work[0] + work_us, self.work[1].max(work_us)];
        self.flags |= if is_late { flags::SLOW } else { 0 };
        if f64::from(self.frame.ticks()) * self.step_s >= FRAME_S * (1.0 - 1e-9) {
            self.end_frame();
        }
        self.rows.add(time_s, values, &self.recording);
    }

    /// Sends what there is, if it is time for it.
    pub fn look_after(&mut self) {
        if self.burst_at.elapsed() < BURST {
            return;
        }
        self.burst_at = Instant::now();
        if self.frames.is_empty() {
            self.end_frame();
        }
        self.hub.frames(self.frames.iter().map(Vec::as_slice));
        self.frames.clear();
        self.rows.send_if_due(&self.recording);
    }

    /// Sends everything: the run is over.
    pub fn finish(mut self) {
        self.end_frame();
        self.hub.frames(self.frames.iter().map(Vec::as_slice));
        self.rows.send(&self.recording);
    }

    fn end_frame(&mut self) {
        let (ticks, Some([start, last])) = (self.frame.ticks(), self.ticks) else {
            return;
        };
        if ticks == 0 {
            return;
        }
        let [sum_us, greatest_us] = std::mem::take(&mut self.work);
        let head = FrameHead {
            time_s: f64::from(last - start) * self.step_s,
            ticks: last.into(),
            work_us: [sum_us / ticks as f32, greatest_us],
            flags: std::mem::take(&mut self.flags),
            ..FrameHead::default()
        };
        let mut bytes = Vec::new();
        self.frame.write(&head, &mut bytes);
        self.frames.push(bytes);
    }
}
