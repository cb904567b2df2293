//! Limits of waiting for an answer.

use std::time::Duration;

/// What a byte may take on the way to a target behind a bridge, which has it from the host at once: 87 us at
/// 115200 bit/s.
const BYTE_TIME: Duration = Duration::from_micros(100);

/// How long to wait for an answer, and how often to ask.
///
/// A wait without an answer doubles the next one, up to eight times the first and 12 s: the target may be slow, and
/// every repeated request is one more for it to answer. The longer wait stays until answers come sooner again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RetryLimits {
    /// First wait, beside the time the bytes of a request take.
    pub timeout: Duration,
    /// Tries of a request, 1 at least.
    pub tries: u32,
}

impl Default for RetryLimits {
    /// Eight tries, the first of a fifth of a second.
    fn default() -> Self {
        Self {
            timeout: Duration::from_millis(200),
            tries: 8,
        }
    }
}

impl RetryLimits {
    /// How long to wait for the answer to a frame of so many bytes.
    pub(super) fn for_frame(&self, bytes: usize) -> Duration {
        self.timeout + BYTE_TIME.saturating_mul(bytes as u32)
    }
}
