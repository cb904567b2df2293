//! A recorded run for the health estimator, as bytes that a host sends to any processor.
//!
//! | bytes | contents |
//! |---|---|
//! | 4 | number of samples, 32 bits |
//! | an image | the estimator's model |
//! | 8 per sample | displacement (m) and force (N), `f32` |
//!
//! Every number is little-endian.

use dashpot_core::health::{Estimate, Health, HealthModel};

use crate::digest::Digest;

/// Maximum samples of a run.
pub const SAMPLES: usize = 40_000;

/// Maximum bytes of a run.
pub const BYTES: usize = 4 + IMAGE_BYTES + 8 * SAMPLES;

const IMAGE_BYTES: usize = HealthModel::IMAGE_BYTES;

/// Ticks between two digested readings.
const EVERY: usize = 500;

/// A recorded run; see the table above.
#[derive(Clone, Copy, Debug)]
pub struct Watch<'a> {
    /// Image of the model.
    pub model: &'a [u8; IMAGE_BYTES],
    /// Displacements (m) and forces (N) alternately, each as the bytes of an `f32`.
    pub samples: &'a [[u8; 8]],
}

impl<'a> Watch<'a> {
    /// Parses `bytes`, ignoring any bytes after the run. Returns `None` if it is truncated.
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let (samples, rest) = bytes.split_first_chunk::<4>()?;
        let (model, rest) = rest.split_first_chunk::<IMAGE_BYTES>()?;
        let samples = u32::from_le_bytes(*samples) as usize;
        let samples = rest.as_chunks().0.get(..samples)?;
        (1..=SAMPLES)
            .contains(&samples.len())
            .then_some(Self { model, samples })
    }

    /// The bytes that [`Self::parse`] reads.
    pub fn to_bytes(&self) -> impl Iterator<Item = u8> {
        let count = (self.samples.len() as u32).to_le_bytes().into_iter();
        let samples = self.samples.as_flattened().iter().copied();
        count.chain(self.model.iter().copied()).chain(samples)
    }

    /// Digest of the bits of the estimates; `tick` computes each tick.
    pub fn run(
        &self,
        model: &HealthModel,
        mut tick: impl FnMut(&mut Health, &HealthModel, &[f32; 2]),
    ) -> Digest {
        let mut digest = Digest::default();
        let mut health = Health::new(model);
        for (count, [x0, x1, x2, x3, f0, f1, f2, f3]) in self.samples.iter().enumerate() {
            let sample = [[*x0, *x1, *x2, *x3], [*f0, *f1, *f2, *f3]].map(f32::from_le_bytes);
            tick(&mut health, model, &sample);
            if count % EVERY == EVERY - 1 {
                let reading = health.reading(model);
                let estimates = [
                    reading.flow_factor,
                    reading.stiffness_n_per_m,
                    reading.clearance_m,
                    reading.lag_s,
                    reading.force_zero_n,
                    reading.added_friction_n,
                ];
                for Estimate { value, sd } in estimates {
                    digest.add(value.to_le_bytes());
                    digest.add(sd.to_le_bytes());
                }
                digest.add(reading.samples.to_le_bytes());
                digest.add(u32::from(reading.status.bits()).to_le_bytes());
            }
        }
        digest
    }
}
