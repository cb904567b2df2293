//! How often viewers get frames.

use std::time::Duration;

/// Simulated time of a frame, s, so that loops are smooth.
pub(super) const FRAME_S: f64 = 0.005;

/// Time between two bursts of frames: a browser draws 60 times a second.
pub(super) const BURST: Duration = Duration::from_micros(16_667);
