//! An image on its way: collected in order, checked whole.

use heapless::Vec;

use super::message::{CHUNK_BYTES, Refusal};
use crate::damper::Damper;

const IMAGE_BYTES: usize = Damper::<f32>::IMAGE_BYTES;

/// The image being received.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loading {
    damper: Option<u8>,
    image: Vec<u8, IMAGE_BYTES>,
}

impl Loading {
    /// Starts over for `damper`.
    pub(crate) fn begin(&mut self, damper: u8, bytes: u32) -> Result<(), Refusal> {
        if bytes as usize != IMAGE_BYTES {
            return Err(Refusal::ImageBytes(IMAGE_BYTES as u32));
        }
        self.damper = Some(damper);
        self.image.clear();
        Ok(())
    }

    pub(crate) fn chunk(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        if self.damper.is_none() {
            return Err(Refusal::NoLoad);
        }
        if offset as usize != self.image.len() {
            return Err(Refusal::Offset(self.image.len() as u32));
        }
        if bytes.len() > CHUNK_BYTES {
            return Err(Refusal::Range);
        }
        self.image
            .extend_from_slice(bytes)
            .map_err(|_| Refusal::ImageBytes(IMAGE_BYTES as u32))
    }

    /// The damper received and its place. What was collected is dropped, right or wrong, but for an
    /// image that is not complete yet.
    pub(crate) fn commit(&mut self, step_s: f32) -> Result<(u8, Damper<f32>), Refusal> {
        let place = self.damper.ok_or(Refusal::NoLoad)?;
        if self.image.len() < IMAGE_BYTES {
            return Err(Refusal::Offset(self.image.len() as u32));
        }
        self.damper = None;
        let damper = Damper::<f32>::from_image(&self.image).map_err(|_| Refusal::Image)?;
        if damper.step_s() == step_s {
            Ok((place, damper))
        } else {
            Err(Refusal::StepSize)
        }
    }
}
