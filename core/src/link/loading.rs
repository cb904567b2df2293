//! An image on its way: collected in order, checked whole.

use heapless::Vec;

use super::message::{CHUNK_BYTES, Refusal};
use crate::damper::Damper;

const IMAGE_BYTES: usize = Damper::<f32>::IMAGE_BYTES;

/// The image being received, and room to check it.
#[derive(Clone, Debug)]
pub(crate) struct Loading {
    place: Option<u8>,
    image: Vec<u8, IMAGE_BYTES>,
    checked: Damper<f32>,
}

impl Loading {
    pub(crate) const fn new() -> Self {
        Self {
            place: None,
            image: Vec::new(),
            checked: Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]),
        }
    }

    /// Starts over for the damper in `place`.
    pub(crate) fn begin(&mut self, place: u8, bytes: u32) -> Result<(), Refusal> {
        if bytes as usize != IMAGE_BYTES {
            return Err(Refusal::ImageBytes(IMAGE_BYTES as u32));
        }
        self.place = Some(place);
        self.image.clear();
        Ok(())
    }

    pub(crate) fn chunk(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        if self.place.is_none() {
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
    pub(crate) fn commit(&mut self, step_s: f32) -> Result<(u8, &Damper<f32>), Refusal> {
        let place = self.place.ok_or(Refusal::NoLoad)?;
        if self.image.len() < IMAGE_BYTES {
            return Err(Refusal::Offset(self.image.len() as u32));
        }
        self.place = None;
        self.checked
            .load_image(&self.image)
            .map_err(|_| Refusal::Image)?;
        if self.checked.step_s() == step_s {
            Ok((place, &self.checked))
        } else {
            Err(Refusal::StepSize)
        }
    }
}
