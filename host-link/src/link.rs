//! Byte links to a target.

use std::time::{Duration, Instant};

use super::{FaultCounts, LinkError};

/// A byte link to a target and back.
pub trait Link {
    /// Sends bytes.
    ///
    /// # Errors
    /// The link is broken.
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError>;

    /// Waits at most `timeout` for bytes and returns their number; 0 if none arrived.
    ///
    /// # Errors
    /// The link is broken.
    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError>;

    /// Current time for measuring waits. A simulated link may have its own clock.
    fn now(&self) -> Instant {
        Instant::now()
    }

    /// Resets the target as a power cycle would.
    ///
    /// # Errors
    /// The link cannot reset its target, which is the default.
    fn reset_target(&mut self) -> Result<(), LinkError> {
        Err(LinkError::CannotReset)
    }

    /// True if [`Link::reset_target`] is supported.
    fn can_reset(&self) -> bool {
        false
    }

    /// Instructions per second of the target's clock, if the link counts instructions exactly.
    fn instructions_per_s(&self) -> Option<f64> {
        None
    }

    /// Faults injected so far.
    fn injected_faults(&self) -> FaultCounts {
        FaultCounts::default()
    }
}

impl<L: Link + ?Sized> Link for Box<L> {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        (**self).send(bytes)
    }
    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        (**self).receive(buffer, timeout)
    }
    fn now(&self) -> Instant {
        (**self).now()
    }
    fn reset_target(&mut self) -> Result<(), LinkError> {
        (**self).reset_target()
    }
    fn can_reset(&self) -> bool {
        (**self).can_reset()
    }
    fn instructions_per_s(&self) -> Option<f64> {
        (**self).instructions_per_s()
    }
    fn injected_faults(&self) -> FaultCounts {
        (**self).injected_faults()
    }
}
