//! Rows in memory as a source of rows.

use std::rc::Rc;

use super::error::RecordingError;
use super::location::RowLocation;
use super::rows::Source;
use super::{Sample, unit};
use dashpot_files::FileError;

/// Rows in memory, in SI units.
pub(super) struct Samples {
    samples: Rc<Vec<Sample>>,
    next: usize,
}

impl Samples {
    pub(super) fn new(samples: Rc<Vec<Sample>>) -> Self {
        Self { samples, next: 0 }
    }
}

impl Source for Samples {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        let Some(sample) = self.samples.get(self.next) else {
            return Ok(false);
        };
        let row = [sample.time_s, sample.displacement_m];
        for (value, number) in values.iter_mut().zip(row) {
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
pub(super) fn si_channels() -> [super::select::SelectedChannel; 2] {
    [unit::Quantity::Time, unit::Quantity::Displacement].map(|quantity| {
        super::select::SelectedChannel {
            index: 0,
            unit: quantity.units()[0],
            reversed: false,
        }
    })
}
