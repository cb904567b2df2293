//! Health estimates, fed with the measured samples of real dampers.

use super::limits::{MAX_MEASURED, MEASURED_BYTES};
use super::refusal::Refusal;
use crate::health::{Health, HealthLoading, HealthModel, HealthReading};

/// Health models and estimates of the first `N` dampers of a bank.
///
/// They change neither a damper's state nor an output, so the guard does not check their memory. An estimate with
/// any bit pattern can be read and fed safely.
#[derive(Clone, Debug)]
pub(crate) struct Watched<const N: usize> {
    models: [HealthModel; N],
    estimates: [Health; N],
}

impl<const N: usize> Watched<N> {
    /// No model is loaded: all bits are zero.
    pub(crate) const fn new() -> Self {
        Self {
            models: [HealthModel::EMPTY; N],
            estimates: [Health::EMPTY; N],
        }
    }

    /// Refuses a damper for which no model can be loaded.
    pub(crate) fn require_slot(&self, damper: u8) -> Result<(), Refusal> {
        let known = usize::from(damper) < N;
        known.then_some(()).ok_or(Refusal::NoHealth)
    }

    /// Loads a slice of a model for a bank with the step `step_s` (s). Returns true once its estimate starts.
    pub(crate) fn load_slice(
        &mut self,
        damper: u8,
        image: &[u8],
        loading: &mut HealthLoading,
        step_s: f32,
    ) -> Result<bool, Refusal> {
        let Some(image) = loading.check_slice(image).map_err(Refusal::HealthImage)? else {
            return Ok(false);
        };
        if image.step_s() != step_s {
            return Err(Refusal::StepSize);
        }
        let index = usize::from(damper);
        let pair = self
            .models
            .get_mut(index)
            .zip(self.estimates.get_mut(index));
        let (model, estimate) = pair.ok_or(Refusal::NoHealth)?;
        if loading.writes_nothing_yet() {
            // There is no estimate until the model is complete.
            *estimate = Health::EMPTY;
        }
        let done = loading.write_slice(&image, model);
        if done {
            *estimate = Health::new(model);
        }
        Ok(done)
    }

    /// Returns model and estimate of a watched damper.
    #[inline]
    fn get_mut(&mut self, index: usize) -> Option<(&HealthModel, &mut Health)> {
        let pair = self.models.get(index).zip(self.estimates.get_mut(index));
        pair.filter(|(model, health)| model.is_marked() && health.is_marked())
    }

    /// Takes a sample. Does nothing and returns false if the damper is not watched.
    #[inline]
    pub(crate) fn sample(&mut self, index: usize, displacement_m: f32, force_n: f32) -> bool {
        let pair = self.get_mut(index);
        pair.map(|(model, health)| health.tick(model, displacement_m, force_n))
            .is_some()
    }

    /// Takes all samples of a request, or none.
    pub(crate) fn samples(&mut self, damper: u8, samples: &[u8]) -> Result<(), Refusal> {
        let (model, health) = self.get_mut(usize::from(damper)).ok_or(Refusal::NoHealth)?;
        let (samples, rest) = samples.as_chunks::<MEASURED_BYTES>();
        if !rest.is_empty() || !(1..=MAX_MEASURED).contains(&samples.len()) {
            return Err(Refusal::Range);
        }
        for [x0, x1, x2, x3, f0, f1, f2, f3] in samples {
            let displacement_m = f32::from_le_bytes([*x0, *x1, *x2, *x3]);
            let force_n = f32::from_le_bytes([*f0, *f1, *f2, *f3]);
            health.tick(model, displacement_m, force_n);
        }
        Ok(())
    }

    /// Returns the reading of a damper.
    pub(crate) fn reading(&mut self, damper: u8) -> Result<HealthReading, Refusal> {
        let (model, health) = self.get_mut(usize::from(damper)).ok_or(Refusal::NoHealth)?;
        Ok(health.reading(model))
    }

    /// Clears status bits and the count of rejected samples.
    pub(crate) fn clear_status(&mut self, damper: u8) -> Result<(), Refusal> {
        let (_, health) = self.get_mut(usize::from(damper)).ok_or(Refusal::NoHealth)?;
        health.clear_status();
        Ok(())
    }
}
