//! Passes the values of each tick to the server.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError};

use super::input::Input;

/// End for the thread that follows the model. Dropping it tells the server that the run is over.
pub struct Feed {
    inputs: SyncSender<Input>,
    /// Ticks that a server in real time was too slow for.
    lost: Arc<AtomicU64>,
    is_realtime: bool,
}

impl Feed {
    pub(super) fn new(inputs: SyncSender<Input>, lost: Arc<AtomicU64>, is_realtime: bool) -> Self {
        Self {
            inputs,
            lost,
            is_realtime,
        }
    }

    /// Passes the values of a tick that ended at `time_s`. In real time this never waits: a tick that the server has no
    /// room for is counted as lost. In virtual time it waits for room.
    pub fn tick(&self, time_s: f64, values: &[f64]) {
        let tick = Input::Tick {
            time_s,
            values: values.to_vec(),
        };
        if !self.is_realtime {
            // A server that has ended needs no ticks.
            let _is_sent = self.inputs.send(tick);
        } else if let Err(TrySendError::Full(_)) = self.inputs.try_send(tick) {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Drop for Feed {
    fn drop(&mut self) {
        // A server that has ended is not told.
        let _is_sent = self.inputs.send(Input::Ended);
    }
}
