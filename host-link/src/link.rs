//! A line of bytes to a target, and how a person names one.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

use super::{DEFAULT_IMAGE, FaultCounts, LinkError, Qemu, Tcp};

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

/// A link by name: `tcp:HOST:PORT`, `serial:DEVICE`, `qemu` or `qemu:IMAGE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkChoice {
    /// A serial line behind a TCP port.
    Tcp(String),
    /// A serial device.
    Serial(PathBuf),
    /// An emulator of our own with this image.
    Qemu(PathBuf),
}

impl FromStr for LinkChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            Some(("tcp", address)) if address.contains(':') => Ok(Self::Tcp(address.into())),
            Some(("serial", device)) if !device.is_empty() => Ok(Self::Serial(device.into())),
            Some(("qemu", image)) if !image.is_empty() => Ok(Self::Qemu(image.into())),
            None if text == "qemu" => Ok(Self::Qemu(DEFAULT_IMAGE.into())),
            _ => Err("allowed: tcp:HOST:PORT, serial:DEVICE, qemu, qemu:IMAGE".into()),
        }
    }
}

impl LinkChoice {
    /// Opens the link, which a real-time thread may use; `baud` (bit/s) is for serial devices.
    ///
    /// # Errors
    /// Nothing answers at the address, the device cannot be opened, or the emulator does not start.
    pub fn open(&self, baud: u32) -> Result<Box<dyn Link + Send>, LinkError> {
        match self {
            Self::Tcp(address) => Ok(Box::new(Tcp::connect(address)?)),
            Self::Serial(device) => open_serial(device, baud),
            Self::Qemu(image) => Ok(Box::new(Qemu::start(image)?)),
        }
    }
}

#[cfg(feature = "serial")]
fn open_serial(device: &std::path::Path, baud: u32) -> Result<Box<dyn Link + Send>, LinkError> {
    Ok(Box::new(super::Serial::open(device, baud)?))
}

#[cfg(not(feature = "serial"))]
fn open_serial(_: &std::path::Path, _: u32) -> Result<Box<dyn Link + Send>, LinkError> {
    Err(LinkError::NoSerial)
}
