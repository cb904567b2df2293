//! Constants of the estimator as bytes, for firmware and C programs.
//!
//! | offset | bytes | holds |
//! |---|---|---|
//! | 0 | 4 | `DAHM` |
//! | 4 | 4 | version of this format |
//! | 8 | 4 per word | the constants, floats as their bits |
//! | end - 4 | 4 | CRC-32 (ISO-HDLC) of all bytes before |
//!
//! All numbers are little-endian.

use core::mem::offset_of;

use super::model::{HealthModel, MARK, MIN_TICKS};
use crate::checksum::{self, crc_32};

const MAGIC: [u8; 4] = *b"DAHM";
/// Version of the format. It changes whenever the meaning of the bytes changes.
const VERSION: u32 = 2;
const HEADER_BYTES: usize = 8;
const CHECK_BYTES: usize = 4;
/// Number of words of a model.
const WORDS: usize = size_of::<HealthModel>() / 4;
/// Number of bytes that a slice checks, and number of words that a slice writes.
const BYTES_PER_SLICE: usize = 124;
const WORDS_PER_SLICE: usize = 64;

// All slices have the same length, so the checksum (shared with images of dampers) needs no case for a shorter slice.
const _: () = assert!((HealthModel::IMAGE_BYTES - CHECK_BYTES).is_multiple_of(BYTES_PER_SLICE));

/// Errors of a health model's image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum HealthImageError {
    /// The image is truncated or too long.
    #[error("{found} bytes, but a health model has {expected}")]
    Length {
        /// Number of bytes of an image.
        expected: u32,
        /// Number of bytes found.
        found: u32,
    },
    /// The first four bytes are not `DAHM`.
    #[error("not a health model: must start with DAHM")]
    Magic,
    /// The image has a different format version, given here.
    #[error("format version {0}, must be {VERSION}")]
    Version(u32),
    /// The CRC-32 does not match: the bytes are damaged.
    #[error("CRC-32 does not match: the bytes are damaged")]
    Checksum,
    /// Invalid constants: the step is not positive or the block is too short.
    #[error("invalid constants: no build produced them")]
    Values,
}

/// Progress of loading an image in slices, between the ticks of a device.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HealthLoading {
    slices: usize,
    crc: u32,
    words: usize,
}

/// Constants of an image that passed all checks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedImage<'a>(&'a [[u8; 4]; WORDS]);

impl HealthLoading {
    /// Progress before the first slice.
    pub(crate) const START: Self = Self {
        slices: 0,
        crc: 0,
        words: 0,
    };

    /// Checks the next slice of an image. Returns the constants once the whole image is checked.
    pub(crate) fn check_slice<'a>(
        &mut self,
        image: &'a [u8],
    ) -> Result<Option<CheckedImage<'a>>, HealthImageError> {
        let length = HealthImageError::Length {
            expected: HealthModel::IMAGE_BYTES as u32,
            found: image.len() as u32,
        };
        let image: &[u8; HealthModel::IMAGE_BYTES] = image.try_into().map_err(|_| length)?;
        let (checked, check) = image.split_last_chunk::<CHECK_BYTES>().ok_or(length)?;
        let (header, words) = checked.split_first_chunk::<HEADER_BYTES>().ok_or(length)?;
        let [m0, m1, m2, m3, version @ ..] = *header;
        if [m0, m1, m2, m3] != MAGIC {
            return Err(HealthImageError::Magic);
        }
        let version = u32::from_le_bytes(version);
        if version != VERSION {
            return Err(HealthImageError::Version(version));
        }
        if let Some(slice) = checked.as_chunks::<BYTES_PER_SLICE>().0.get(self.slices) {
            self.crc = checksum::continued(self.crc, slice);
            self.slices += 1;
            return Ok(None);
        }
        if self.crc != u32::from_le_bytes(*check) {
            return Err(HealthImageError::Checksum);
        }
        let words = words.as_chunks().0.try_into().map_err(|_| length)?;
        let image = CheckedImage(words);
        let possible = image.word(offset_of!(HealthModel, mark)) == MARK
            && image.word(offset_of!(HealthModel, block_ticks)) >= MIN_TICKS
            && image.half_step_s() > 0.0
            && image.half_step_s().is_finite();
        possible
            .then_some(Some(image))
            .ok_or(HealthImageError::Values)
    }
}

impl HealthLoading {
    /// True if no word has been written yet.
    #[cfg(feature = "link")]
    pub(crate) fn writes_nothing_yet(&self) -> bool {
        self.words == 0
    }

    /// Writes the next slice of checked constants to a model, without a copy on the stack. Returns true after the last
    /// slice.
    pub(crate) fn write_slice(
        &mut self,
        image: &CheckedImage<'_>,
        model: &mut HealthModel,
    ) -> bool {
        let numbers: &mut [u32; WORDS] = zerocopy::transmute_mut!(model);
        let pairs = numbers.iter_mut().zip(image.0).skip(self.words);
        for (number, bytes) in pairs.take(WORDS_PER_SLICE) {
            *number = u32::from_le_bytes(*bytes);
        }
        self.words += WORDS_PER_SLICE;
        self.words >= WORDS
    }
}

impl CheckedImage<'_> {
    fn word(&self, offset: usize) -> u32 {
        self.0
            .get(offset / 4)
            .map_or(0, |bytes| u32::from_le_bytes(*bytes))
    }

    fn half_step_s(&self) -> f32 {
        f32::from_bits(self.word(offset_of!(HealthModel, half_step_s)))
    }

    /// Step (s).
    #[cfg(feature = "link")]
    pub(crate) fn step_s(&self) -> f32 {
        2.0 * self.half_step_s()
    }
}

impl HealthModel {
    /// Number of bytes of an image.
    pub const IMAGE_BYTES: usize = HEADER_BYTES + 4 * WORDS + CHECK_BYTES;

    /// Placeholder before a model is loaded: all bits are zero.
    pub(crate) const EMPTY: Self = zerocopy::transmute!([0_u32; WORDS]);

    /// Returns this model as bytes, with baseline and limits.
    pub fn to_image(&self) -> [u8; Self::IMAGE_BYTES] {
        let words: [u32; WORDS] = zerocopy::transmute!(*self);
        let header = MAGIC.into_iter().chain(VERSION.to_le_bytes());
        let bytes = header.chain(words.into_iter().flat_map(u32::to_le_bytes));
        let mut image = [0; Self::IMAGE_BYTES];
        for (to, byte) in image.iter_mut().zip(bytes) {
            *to = byte;
        }
        if let Some((checked, check)) = image.split_last_chunk_mut::<CHECK_BYTES>() {
            *check = crc_32(checked).to_le_bytes();
        }
        image
    }

    /// Returns the model of an image, bit for bit.
    ///
    /// # Errors
    /// The bytes are not from [`Self::to_image`] of this version.
    ///
    /// ```
    /// # #[cfg(feature = "builder")] {
    /// use dashpot_core::health::{HealthImageError, HealthModel, HealthSettings};
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    ///
    /// let checked = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6)).check()?;
    /// let model = checked.health_model(&HealthSettings::new(50e-6, 50.0), 1e-3)?;
    /// let mut image = model.to_image();
    /// assert_eq!(HealthModel::from_image(&image), Ok(model));
    /// image[100] ^= 1;
    /// assert_eq!(HealthModel::from_image(&image), Err(HealthImageError::Checksum));
    /// # }
    /// # Ok::<(), dashpot_core::BuildError>(())
    /// ```
    pub fn from_image(image: &[u8]) -> Result<Self, HealthImageError> {
        let mut loading = HealthLoading::START;
        let mut model = Self::EMPTY;
        loop {
            if let Some(checked) = loading.check_slice(image)?
                && loading.write_slice(&checked, &mut model)
            {
                return Ok(model);
            }
        }
    }
}

#[cfg(test)]
mod tests;
