//! Rows that were read already.

use std::rc::Rc;

use super::error::RecordingError;
use super::place::Place;
use super::rows::Source;
use super::{Sample, unit};
use dashpot_files::FileError;

/// Rows in memory, in SI.
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
        for (value, of) in values
            .iter_mut()
            .zip([sample.time_s, sample.displacement_m])
        {
            *value = of;
        }
        self.next += 1;
        Ok(true)
    }

    fn missing(&self, _: usize) -> RecordingError {
        RecordingError::NotFinite {
            cell: f64::NAN.to_string(),
        }
    }

    fn place(&self) -> Place {
        Place::Row(self.next as u64)
    }

    fn position(&self) -> u64 {
        self.next as u64
    }
}

/// The channels of rows in SI.
pub(super) fn chosen() -> [super::select::Chosen; 2] {
    [unit::Quantity::Time, unit::Quantity::Displacement].map(|quantity| super::select::Chosen {
        index: 0,
        unit: quantity.units()[0],
        reversed: false,
    })
}
