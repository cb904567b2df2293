//! What a master may calibrate.

use dashpot_core::xcp::ErrorCode;

/// Pages of parameters. The master reads and writes any page; the model uses one.
pub trait Parameters: Send {
    /// Number of pages; 0 if nothing can be calibrated.
    fn pages(&self) -> u8;

    /// Returns the values of a page; empty for an unknown page.
    fn values(&self, page: u8) -> &[f64];

    /// Changes values of a page from number `first` on: all of them or, on an error, none. If the model uses the page,
    /// it takes them over before its next tick.
    ///
    /// # Errors
    /// A value is not allowed.
    fn write(&mut self, page: u8, first: usize, values: &[f64]) -> Result<(), ErrorCode>;

    /// Returns the page that the model uses.
    fn page(&self) -> u8;

    /// Lets the model use another page before its next tick.
    ///
    /// # Errors
    /// Its values are not allowed.
    fn use_page(&mut self, page: u8) -> Result<(), ErrorCode>;

    /// Tells the time of the last measured tick (s), for records of the changes.
    fn tick(&mut self, time_s: f64) {
        let _ = time_s;
    }
}

/// Nothing can be calibrated.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fixed;

impl Parameters for Fixed {
    fn pages(&self) -> u8 {
        0
    }
    fn values(&self, _: u8) -> &[f64] {
        &[]
    }
    fn write(&mut self, _: u8, _: usize, _: &[f64]) -> Result<(), ErrorCode> {
        Err(ErrorCode::WriteProtected)
    }
    fn page(&self) -> u8 {
        0
    }
    fn use_page(&mut self, _: u8) -> Result<(), ErrorCode> {
        Err(ErrorCode::PageNotValid)
    }
}
