//! Estimates of the dampers' health, fed with what sensors measure on real ones.

use super::message::{MEASURED_BYTES, MOST_MEASURED};
use super::refusal::Refusal;
use crate::health::{Health, HealthLoading, HealthModel, HealthReading};

/// The first `N` places of a bank, each with a model of health once one was loaded.
///
/// Nothing here moves a damper's state or an output, so memory is not guarded: with any bits an estimate is read
/// and fed without harm.
#[derive(Clone, Debug)]
pub(crate) struct Watched<const N: usize> {
    models: [HealthModel; N],
    estimates: [Health; N],
}

impl<const N: usize> Watched<N> {
    /// No model yet.
    pub(crate) const fn new() -> Self {
        Self {
            models: [HealthModel::EMPTY; N],
            estimates: [Health::EMPTY; N],
        }
    }

    /// Refuses a place that no model can be loaded for.
    pub(crate) fn has(&self, damper: u8) -> Result<(), Refusal> {
        let known = usize::from(damper) < N;
        known.then_some(()).ok_or(Refusal::NoHealth)
    }

    /// A slice of loading a model for a bank of step `step_s` (s); true when its estimate begins.
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
        let place = usize::from(damper);
        let pair = self
            .models
            .get_mut(place)
            .zip(self.estimates.get_mut(place));
        let (model, estimate) = pair.ok_or(Refusal::NoHealth)?;
        if loading.writes_nothing_yet() {
            // None until its model is whole.
            *estimate = Health::EMPTY;
        }
        let done = loading.write_slice(&image, model);
        if done {
            *estimate = Health::new(model);
        }
        Ok(done)
    }

    /// The model and the estimate of a place that has them.
    #[inline]
    fn get_mut(&mut self, place: usize) -> Option<(&HealthModel, &mut Health)> {
        let pair = self.models.get(place).zip(self.estimates.get_mut(place));
        pair.filter(|(model, health)| model.is_marked() && health.is_marked())
    }

    /// Takes a sample; false, and no more, in a place without a model.
    #[inline]
    pub(crate) fn sample(&mut self, place: usize, displacement_m: f32, force_n: f32) -> bool {
        let pair = self.get_mut(place);
        pair.map(|(model, health)| health.tick(model, displacement_m, force_n))
            .is_some()
    }

    /// Takes samples as a request has them, all or none.
    pub(crate) fn samples(&mut self, damper: u8, samples: &[u8]) -> Result<(), Refusal> {
        let (model, health) = self.get_mut(usize::from(damper)).ok_or(Refusal::NoHealth)?;
        let (samples, rest) = samples.as_chunks::<MEASURED_BYTES>();
        if !rest.is_empty() || !(1..=MOST_MEASURED).contains(&samples.len()) {
            return Err(Refusal::Range);
        }
        for [x0, x1, x2, x3, f0, f1, f2, f3] in samples {
            let displacement_m = f32::from_le_bytes([*x0, *x1, *x2, *x3]);
            let force_n = f32::from_le_bytes([*f0, *f1, *f2, *f3]);
            health.tick(model, displacement_m, force_n);
        }
        Ok(())
    }

    /// What is known of a damper.
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
