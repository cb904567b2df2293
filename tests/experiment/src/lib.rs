//! An experiment that drives one damper or a bank of twelve with a motion, as bytes that a host sends to any processor.
//!
//! | bytes | contents |
//! |---|---|
//! | 12 | 32-bit numbers: 1 for the bank, 0 for one damper; steps; samples of the motion |
//! | two images | the damper, and another to swap in |
//! | 4 per sample | displacement (m), `f32` |
//!
//! Every number is little-endian.
#![no_std]

pub mod digest;
#[cfg(feature = "network")]
pub mod network;
pub mod transfer;
pub mod watch;

use dashpot_core::{Damper, DamperState};
use digest::Digest;

/// Dampers in a bank.
pub const BANK: usize = 12;

/// Maximum samples of a motion.
pub const SAMPLES: usize = 100_000;

/// Maximum bytes of an experiment.
pub const BYTES: usize = HEADER_BYTES + 2 * IMAGE_BYTES + 4 * SAMPLES;

const HEADER_BYTES: usize = 12;
const IMAGE_BYTES: usize = Damper::<f32>::IMAGE_BYTES;

/// Each lane of a bank lags the one before it by this number of ticks.
const LAG: u32 = 9;

/// An experiment; see the table above.
#[derive(Clone, Copy, Debug)]
pub struct Experiment<'a> {
    /// True for a bank of [`BANK`], false for one damper.
    pub bank: bool,
    /// Steps.
    pub steps: u32,
    /// Image of the damper.
    pub damper: &'a [u8; IMAGE_BYTES],
    /// Image of another damper.
    pub other: &'a [u8; IMAGE_BYTES],
    /// Displacements (m), each as the bytes of an `f32`.
    pub motion_m: &'a [[u8; 4]],
}

impl<'a> Experiment<'a> {
    /// Parses `bytes`, ignoring any bytes after the experiment. Returns `None` if it is truncated or its motion does
    /// not have 2 to [`SAMPLES`] samples.
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let (header, rest) = bytes.split_first_chunk::<HEADER_BYTES>()?;
        let (damper, rest) = rest.split_first_chunk::<IMAGE_BYTES>()?;
        let (other, rest) = rest.split_first_chunk::<IMAGE_BYTES>()?;
        let ([bank, steps, samples], []) = header.as_chunks::<4>() else {
            return None;
        };
        let samples = u32::from_le_bytes(*samples) as usize;
        Some(Self {
            bank: u32::from_le_bytes(*bank) != 0,
            steps: u32::from_le_bytes(*steps),
            damper,
            other,
            motion_m: rest
                .as_chunks()
                .0
                .get(..samples)
                .filter(|motion| (2..=SAMPLES).contains(&motion.len()))?,
        })
    }

    /// The bytes that [`Self::parse`] reads.
    pub fn to_bytes(&self) -> impl Iterator<Item = u8> {
        let header = [u32::from(self.bank), self.steps, self.motion_m.len() as u32];
        let header = header.into_iter().flat_map(u32::to_le_bytes);
        let images = self.damper.iter().chain(self.other);
        header
            .chain(images.copied())
            .chain(self.motion_m.as_flattened().iter().copied())
    }

    /// Displacement (m) of a lane at a step: the motion runs to its end and back, repeatedly.
    pub fn displacement_m(&self, step: u32, lane: usize) -> f32 {
        let last = self.motion_m.len() as u32 - 1;
        let sample = (step + LAG * lane as u32) % (2 * last);
        let sample = sample.min(2 * last - sample);
        f32::from_le_bytes(self.motion_m[sample as usize])
    }

    /// Digest of the bits of all forces; `step` or, for a bank, `step_bank` computes each step.
    pub fn run(
        &self,
        damper: &Damper<f32>,
        mut step: impl FnMut(&Damper<f32>, &mut DamperState<f32>, f32) -> f32,
        mut step_bank: impl FnMut(
            &[&Damper<f32>; BANK],
            &mut [DamperState<f32>; BANK],
            &[f32; BANK],
            &mut [f32; BANK],
        ),
    ) -> Digest {
        let mut digest = Digest::default();
        let mut states = core::array::from_fn(|lane| damper.at_rest(self.displacement_m(0, lane)));
        let mut forces = [0.0_f32; BANK];
        for count in 0..self.steps {
            if self.bank {
                let displacements = core::array::from_fn(|lane| self.displacement_m(count, lane));
                step_bank(&[damper; BANK], &mut states, &displacements, &mut forces);
                for force in forces {
                    digest.add(force.to_le_bytes());
                }
            } else {
                let force = step(damper, &mut states[0], self.displacement_m(count, 0));
                digest.add(force.to_le_bytes());
            }
        }
        digest
    }
}
