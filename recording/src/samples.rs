//! Rows in memory as a source of rows.

use std::rc::Rc;

use super::error::RecordingError;
use super::location::RowLocation;
use super::rows::Source;
use super::unit::Quantity;
use dashpot_files::FileError;

/// Rows in memory, in SI units.
pub(super) struct Samples<T, const N: usize> {
    samples: Rc<Vec<T>>,
    row: fn(&T) -> [f64; N],
    next: usize,
}

impl<T, const N: usize> Samples<T, N> {
    pub(super) fn new(samples: Rc<Vec<T>>, row: fn(&T) -> [f64; N]) -> Self {
        let next = 0;
        Self { samples, row, next }
    }
}

impl<T, const N: usize> Source for Samples<T, N> {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        let Some(sample) = self.samples.get(self.next) else {
            return Ok(false);
        };
        for (value, number) in values.iter_mut().zip((self.row)(sample)) {
            *value = number;
        }
        self.next += 1;
        Ok(true)
    }

    fn missing(&self, _: usize) -> RecordingError {
        RecordingError::NotFinite {
            cell: f64::NAN.to_string(),
        }
    }

    fn location(&self) -> RowLocation {
        RowLocation::Row(self.next as u64)
    }

    fn position(&self) -> u64 {
        self.next as u64
    }
}

/// Returns the channels of rows in SI units.
pub(super) fn si_channels<const N: usize>(
    quantities: [Quantity; N],
) -> [super::select::SelectedChannel; N] {
    quantities.map(|quantity| super::select::SelectedChannel {
        index: 0,
        unit: quantity.units()[0],
        reversed: false,
    })
}
