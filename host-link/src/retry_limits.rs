//! Limits for waiting and repeating requests.

use std::time::Duration;

/// Time per byte to a target behind a bridge, which buffers the bytes of the host: 87 us at 115200 bit/s, rounded up.
const BYTE_TIME: Duration = Duration::from_micros(100);

/// Waiting time for an answer and number of tries.
///
/// Each wait without an answer doubles the next wait, up to eight times the first wait and at most 12 s: the target may
/// be slow, and it must answer every repeated request. Waits become shorter again when answers arrive sooner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RetryLimits {
    /// First wait, in addition to the transmission time of the request.
    pub timeout: Duration,
    /// Number of tries, at least 1.
    pub tries: u32,
}

impl Default for RetryLimits {
    /// Eight tries with a first wait of 200 ms.
    fn default() -> Self {
        Self {
            timeout: Duration::from_millis(200),
            tries: 8,
        }
    }
}

impl RetryLimits {
    /// Returns the first wait for the answer to a frame with this number of bytes.
    pub(super) fn for_frame(&self, bytes: usize) -> Duration {
        self.timeout + BYTE_TIME.saturating_mul(bytes as u32)
    }
}
