//! A simulated target: the device code of the firmware, running in this process.

use std::collections::VecDeque;
use std::time::Duration;

use dashpot_core::Damper;
use dashpot_core::link::{Clock, Device, StepSizeError};

use super::{Link, LinkError};

/// A device with `N` dampers in this process. It answers at once or, after a corrupted frame, not at all, so the host
/// never waits.
#[derive(Debug)]
pub struct Desk<const N: usize> {
    bank: [Damper<f32>; N],
    device: Box<Device<N, N>>,
    answers: VecDeque<u8>,
}

impl<const N: usize> Desk<N> {
    /// Creates a device with these dampers in the state after power-on.
    ///
    /// # Errors
    /// The dampers are not all built for the same step.
    pub fn new(bank: [Damper<f32>; N]) -> Result<Self, StepSizeError> {
        Ok(Self {
            device: power_on(&bank)?,
            bank,
            answers: VecDeque::new(),
        })
    }

    /// Returns the device.
    pub fn device(&mut self) -> &mut Device<N, N> {
        &mut self.device
    }
}

fn power_on<const N: usize>(bank: &[Damper<f32>; N]) -> Result<Box<Device<N, N>>, StepSizeError> {
    let clock = Clock::new(|| 0, 1_000_000);
    let mut device = Box::new(Device::new());
    device.start(&bank.each_ref(), clock)?;
    Ok(device)
}

impl<const N: usize> Link for Desk<N> {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        for byte in bytes {
            let mut answered = self.device.receive(*byte);
            while self.device.is_busy() {
                answered = self.device.advance();
            }
            if answered {
                self.answers.extend(self.device.response());
            }
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], _: Duration) -> Result<usize, LinkError> {
        let count = buffer.len().min(self.answers.len());
        for (slot, byte) in buffer.iter_mut().zip(self.answers.drain(..count)) {
            *slot = byte;
        }
        Ok(count)
    }

    fn reset_target(&mut self) -> Result<(), LinkError> {
        // This cannot fail, because the same bank was started before.
        self.device = power_on(&self.bank)?;
        Ok(())
    }

    fn can_reset(&self) -> bool {
        true
    }
}
