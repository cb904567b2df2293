//! Health of the real damper that is assigned to a slot of the target.

use dashpot_core::health::{HealthModel, HealthReading};
use dashpot_core::link::{MAX_MEASURED, Request, Response};

use super::{Client, Link, LinkError};

/// Displacement and force measured on a real damper at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HealthSample {
    /// Relative displacement of the seats (m), positive in extension.
    pub displacement_m: f32,
    /// Force (N), positive if it resists extension.
    pub force_n: f32,
}

impl<L: Link> Client<L> {
    /// Loads a model into a slot and starts its estimate.
    ///
    /// # Errors
    /// The target does not answer, or refuses: the slot does not exist or is not monitored, or the model is for another
    /// step.
    pub fn load_health(&mut self, slot: u8, model: &HealthModel) -> Result<(), LinkError> {
        let request = Request::LoadHealth {
            damper: slot,
            image: &model.to_image(),
        };
        self.expect_done(&request)
    }

    /// Sends measured samples, one per step, to the estimate of a slot.
    ///
    /// # Errors
    /// The target does not answer, or refuses, for example because the slot has no model. The samples are sent in
    /// several requests; the target has used those sent before the failed request.
    pub fn measure(&mut self, slot: u8, samples: &[HealthSample]) -> Result<(), LinkError> {
        for samples in samples.chunks(MAX_MEASURED) {
            let numbers = samples
                .iter()
                .flat_map(|sample| [sample.displacement_m, sample.force_n]);
            let bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
            self.expect_done(&Request::Measure {
                damper: slot,
                samples: &bytes,
            })?;
        }
        Ok(())
    }

    /// Returns the estimate of a slot.
    ///
    /// # Errors
    /// The target does not answer, or refuses, for example because the slot has no model.
    pub fn health(&mut self, slot: u8) -> Result<HealthReading, LinkError> {
        self.reading(&Request::Health { damper: slot })
    }

    /// Clears the status bits of the estimate of a slot and returns the previous reading.
    ///
    /// # Errors
    /// The same as for [`Client::health`].
    pub fn clear_health(&mut self, slot: u8) -> Result<HealthReading, LinkError> {
        self.reading(&Request::ClearHealth { damper: slot })
    }

    fn expect_done(&mut self, request: &Request<'_>) -> Result<(), LinkError> {
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
