//! A serial device.

use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;
use std::time::Duration;

use serialport::SerialPort;

use super::{Link, LinkError};

/// A serial device with 8 data bits, no parity and no flow control.
pub struct Serial {
    port: Box<dyn SerialPort>,
    name: String,
}

impl Serial {
    /// Opens `device` at `baud` bit/s.
    ///
    /// # Errors
    /// The device does not exist, cannot be opened, or does not support the rate.
    pub fn open(device: &Path, baud: u32) -> Result<Self, LinkError> {
        let name = format!("serial:{}", device.display());
        let port = serialport::new(device.to_string_lossy(), baud)
            .open()
            .map_err(|error| {
                LinkError::line(
                    &name,
                    &format!("cannot open at {baud} bit/s: "),
                    error.into(),
                )
            })?;
        Ok(Self { port, name })
    }

    fn error(&self, action: &str, source: io::Error) -> LinkError {
        LinkError::line(&self.name, action, source)
    }
}

impl Link for Serial {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        // The wait for the answer starts when the bytes have been sent.
        self.port
            .write_all(bytes)
            .and_then(|()| self.port.flush())
            .map_err(|error| self.error("cannot send: ", error))
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.port
            .set_timeout(timeout)
            .map_err(|error| self.error("", error.into()))?;
        match self.port.read(buffer) {
            Ok(0) => Err(self.error("", io::Error::other("the device was disconnected"))),
            Ok(count) => Ok(count),
            Err(error) => match error.kind() {
                ErrorKind::TimedOut | ErrorKind::Interrupted => Ok(0),
                _ => Err(self.error("cannot receive: ", error)),
            },
        }
    }
}
