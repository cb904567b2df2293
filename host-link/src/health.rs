//! Health of the real damper that a place of a target stands for.

use dashpot_core::health::{HealthModel, HealthReading};
use dashpot_core::link::{MAX_MEASURED, Request, Response};

use super::{Client, Link, LinkError};

impl<L: Link> Client<L> {
    /// Begins an estimate in a place with a model.
    ///
    /// # Errors
    /// No answer, or a refusal: a place that is not there or not watched, a model for another step.
    pub fn load_health(&mut self, place: u8, model: &HealthModel) -> Result<(), LinkError> {
        let request = Request::LoadHealth {
            damper: place,
            image: &model.to_image(),
        };
        self.done(&request)
    }

    /// Gives the estimate of a place samples of displacement (m) and force (N), one a step.
    ///
    /// # Errors
    /// No answer, or a refusal, as of a place without a model; samples before that were taken.
    pub fn measure(&mut self, place: u8, samples: &[(f32, f32)]) -> Result<(), LinkError> {
        for samples in samples.chunks(MAX_MEASURED) {
            let pairs = samples.iter();
            let numbers = pairs.flat_map(|(displacement_m, force_n)| [displacement_m, force_n]);
            let bytes: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
            self.done(&Request::Measure {
                damper: place,
                samples: &bytes,
            })?;
        }
        Ok(())
    }

    /// The estimate of a place.
    ///
    /// # Errors
    /// No answer, or a refusal, as of a place without a model.
    pub fn health(&mut self, place: u8) -> Result<HealthReading, LinkError> {
        self.reading(&Request::Health { damper: place })
    }

    /// Clears the status bits of a place's estimate; what it told before.
    ///
    /// # Errors
    /// As [`Client::health`].
    pub fn clear_health(&mut self, place: u8) -> Result<HealthReading, LinkError> {
        self.reading(&Request::ClearHealth { damper: place })
    }

    fn done(&mut self, request: &Request<'_>) -> Result<(), LinkError> {
        match self.request(request)? {
            Response::Done => Ok(()),
            _ => Err(LinkError::Unreadable),
        }
    }

    fn reading(&mut self, request: &Request<'_>) -> Result<HealthReading, LinkError> {
        match self.request(request)? {
            Response::Health(reading) => Ok(reading),
            _ => Err(LinkError::Unreadable),
        }
    }
}
