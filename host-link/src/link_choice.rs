//! Links chosen by name.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use super::{DEFAULT_IMAGE, Link, LinkError, Qemu, Tcp};

/// A link chosen by name: `tcp:HOST:PORT`, `serial:DEVICE`, `qemu` or `qemu:IMAGE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkChoice {
    /// A serial line behind a TCP port.
    Tcp(String),
    /// A serial device.
    Serial(PathBuf),
    /// An emulator that this process starts with this image.
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

impl fmt::Display for LinkChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tcp(address) => write!(f, "tcp:{address}"),
            Self::Serial(device) => write!(f, "serial:{}", device.display()),
            Self::Qemu(image) => write!(f, "qemu:{}", image.display()),
        }
    }
}

impl LinkChoice {
    /// Opens the link, which may be moved to a real-time thread. `baud` (bit/s) applies to serial devices only.
    ///
    /// # Errors
    /// Nothing listens at the address, the device cannot be opened, or the emulator does not start.
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
