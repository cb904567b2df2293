//! Rows on their way to the thread that writes the recording.

use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use super::recorded::RecordingState;
use super::recorder::{Block, GrowingMdf};
use crate::commands::nearest_nanosecond;

/// Largest number of rows between two writes. A killed process loses so many.
const BLOCK_ROWS: u64 = 200;

/// Time between two writes.
const BLOCK: Duration = Duration::from_millis(100);

/// Rows that have not been sent yet.
pub(super) struct Rows {
    /// `None` without a recording.
    blocks: Option<SyncSender<Block>>,
    epoch: u32,
    rows: u64,
    bytes: Vec<u8>,
    sent_at: Instant,
}

impl Rows {
    /// No rows, of the first run.
    pub fn new(blocks: Option<SyncSender<Block>>) -> Self {
        Self {
            blocks,
            epoch: 1,
            rows: 0,
            bytes: Vec::new(),
            sent_at: Instant::now(),
        }
    }

    /// Takes a row, if there is a recording and it is on.
    pub fn add(&mut self, time_s: f64, values: &[f32], recording: &RecordingState) {
        if self.blocks.is_none() || !recording.is_on() {
            return;
        }
        GrowingMdf::add_row(nearest_nanosecond(time_s), values, &mut self.bytes);
        self.rows += 1;
        if self.rows >= BLOCK_ROWS {
            self.send(recording);
        }
    }

    /// Sends the rows of this run, and begins with another.
    pub fn begin(&mut self, epoch: u32, recording: &RecordingState) {
        self.send(recording);
        self.epoch = epoch;
    }

    /// Number of the run, from 1.
    pub fn epoch(&self) -> u32 {
        self.epoch
    }

    /// Sends the rows if it is time for it. Returns true if it was.
    pub fn send_if_due(&mut self, recording: &RecordingState) -> bool {
        let is_due = self.sent_at.elapsed() >= BLOCK;
        if is_due {
            self.sent_at = Instant::now();
            self.send(recording);
        }
        is_due
    }

    /// Sends all rows; they are counted as left out if the disk is too slow.
    pub fn send(&mut self, recording: &RecordingState) {
        let rows = std::mem::take(&mut self.rows);
        let bytes = std::mem::take(&mut self.bytes);
        let Some(blocks) = self.blocks.as_ref().filter(|_| rows > 0) else {
            return;
        };
        let block = Block {
            epoch: self.epoch,
            rows,
            bytes,
        };
        if blocks.try_send(block).is_err() {
            recording.leave_out(rows);
        }
    }
}
