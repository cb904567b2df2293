//! What a slave measures and calibrates.

use super::ErrorCode;

/// Address of a byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Address {
    /// Address extension.
    pub extension: u8,
    /// Address.
    pub offset: u32,
}

impl Address {
    /// Returns the address `bytes` bytes further on; it wraps around.
    pub(super) fn plus(self, bytes: usize) -> Self {
        Self {
            offset: self.offset.wrapping_add(bytes as u32),
            ..self
        }
    }
}

/// A text that a master can upload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Text {
    /// Name of the slave (GET_ID type 0).
    Name,
    /// Name of the A2L file without path and extension (GET_ID type 1).
    A2lName,
    /// Contents of the A2L file (GET_ID type 4).
    A2l,
    /// Version of the memory's layout, which the A2L file repeats (GET_ID type 5).
    Epk,
    /// Name of an event channel.
    Event(u16),
}

/// An event channel: what a DAQ list is sampled at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Cycle in the unit; 0 if the event is not cyclic.
    pub cycle: u8,
    /// Power of ten of the unit: 0 is 1 ns, 3 is 1 us, 6 is 1 ms.
    pub unit: u8,
}

/// Who uses a page of the calibration segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// The model that runs.
    Model,
    /// The master, which reads and writes it.
    Master,
}

/// The calibration segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// First address.
    pub address: u32,
    /// Size, bytes.
    pub length: u32,
    /// Number of pages.
    pub pages: u8,
}

/// Memory of a slave. Only [`Self::read`] is required: by default, nothing can be calibrated.
pub trait Memory {
    /// Copies the bytes from `address` on.
    ///
    /// # Errors
    /// There is no memory at one of the addresses.
    fn read(&self, address: Address, into: &mut [u8]) -> Result<(), ErrorCode>;

    /// Changes the bytes from `address` on: all of them or, on an error, none.
    ///
    /// # Errors
    /// The memory cannot be written, or a value is not allowed.
    fn write(&mut self, address: Address, bytes: &[u8]) -> Result<(), ErrorCode> {
        let _ = (address, bytes);
        Err(ErrorCode::WriteProtected)
    }

    /// Returns a text; empty if there is none.
    fn text(&self, text: Text) -> &[u8] {
        let _ = text;
        &[]
    }

    /// Time of the values, us; it wraps around.
    fn clock_us(&self) -> u32 {
        0
    }

    /// Returns an event channel; channels count from 0 without gaps.
    fn event(&self, channel: u16) -> Option<Event> {
        let _ = channel;
        None
    }

    /// The calibration segment, number 0; `None` if nothing can be calibrated.
    fn segment(&self) -> Option<Segment> {
        None
    }

    /// Returns the number of the page in use.
    fn page(&self, of: Page) -> u8 {
        let _ = of;
        0
    }

    /// Selects a page; the slave has checked that it exists.
    ///
    /// # Errors
    /// The page cannot be used.
    fn set_page(&mut self, of: Page, page: u8) -> Result<(), ErrorCode> {
        let _ = (of, page);
        Err(ErrorCode::PageNotValid)
    }

    /// Copies a page to another; the slave has checked that both exist.
    ///
    /// # Errors
    /// The other page cannot be written.
    fn copy_page(&mut self, from: u8, to: u8) -> Result<(), ErrorCode> {
        let _ = (from, to);
        Err(ErrorCode::WriteProtected)
    }
}
