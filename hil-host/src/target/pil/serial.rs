//! A serial device.

use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::time::Duration;

use serialport::SerialPort;

use super::Link;
use crate::error::{Failure, Outcome};

/// A serial device, 8 data bits, no parity, no flow control.
pub struct Serial {
    port: Box<dyn SerialPort>,
    name: String,
}

impl Serial {
    /// Opens `device` at `baud` bits a second.
    ///
    /// # Errors
    /// There is no such device, it may not be opened, or it does not know the rate.
    pub fn open(device: &Path, baud: u32) -> Outcome<Self> {
        let name = format!("serial:{}", device.display());
        let port = serialport::new(device.to_string_lossy(), baud)
            .open()
            .map_err(|error| {
                Failure::new(format!("{name}: cannot open at {baud} bit/s: {error}"))
            })?;
        Ok(Self { port, name })
    }

    fn failure(&self, what: impl std::fmt::Display) -> Failure {
        Failure::new(format!("{}: {what}", self.name))
    }
}

impl Link for Serial {
    fn send(&mut self, bytes: &[u8]) -> Outcome<()> {
        // The wait for the answer begins when the bytes have left.
        self.port
            .write_all(bytes)
            .and_then(|()| self.port.flush())
            .map_err(|error| self.failure(format_args!("cannot send: {error}")))
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Outcome<usize> {
        self.port
            .set_timeout(timeout)
            .map_err(|error| self.failure(error))?;
        match self.port.read(buffer) {
            Ok(0) => Err(self.failure("the device is gone")),
            Ok(count) => Ok(count),
            Err(error) => match error.kind() {
                ErrorKind::TimedOut | ErrorKind::Interrupted => Ok(0),
                _ => Err(self.failure(format_args!("cannot receive: {error}"))),
            },
        }
    }
}
