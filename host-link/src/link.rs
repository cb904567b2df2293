//! A line of bytes to a target.

use std::time::{Duration, Instant};

use super::{FaultCounts, LinkError};

/// A line of bytes to a target and back.
pub trait Link {
    /// Sends bytes.
    ///
    /// # Errors
    /// The line is broken.
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError>;

    /// Waits up to `timeout` for bytes; how many came, 0 when none did.
    ///
    /// # Errors
    /// The line is broken.
    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError>;

    /// The time that waits are measured in; a simulated line has a clock of its own.
    fn now(&self) -> Instant {
        Instant::now()
    }

    /// Resets the target as a power cycle would.
    ///
    /// # Errors
    /// This line cannot, unless it says otherwise.
    fn reset_target(&mut self) -> Result<(), LinkError> {
        Err(LinkError::CannotReset)
    }

    /// Whether [`Link::reset_target`] can.
    fn can_reset(&self) -> bool {
        false
    }

    /// Instructions of the target in a second of its clock, where they are counted exactly.
    fn instructions_per_s(&self) -> Option<f64> {
        None
    }

    /// Faults made on purpose so far.
    fn faults_made(&self) -> FaultCounts {
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
    fn faults_made(&self) -> FaultCounts {
        (**self).faults_made()
    }
}
