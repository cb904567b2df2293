//! The estimator's constants as bytes: how a host hands them to firmware and to programs in C.
//!
//! | offset | bytes | holds |
//! |---|---|---|
//! | 0 | 4 | `DAHM` |
//! | 4 | 4 | version of this format |
//! | 8 | 4 a word | the constants, floats as their bits |
//! | end - 4 | 4 | CRC-32 (ISO-HDLC) of all bytes before |
//!
//! Every number is little-endian.

use core::mem::offset_of;

use super::model::{FEWEST_TICKS, HealthModel, MARK};
use crate::encoding::checksum;
use crate::encoding::crc_32;

const MAGIC: [u8; 4] = *b"DAHM";
/// Changes whenever the same bytes would mean another model.
const VERSION: u32 = 2;
const HEADER_BYTES: usize = 8;
const CHECK_BYTES: usize = 4;
/// Words of a model.
const WORDS: usize = size_of::<HealthModel>() / 4;
/// Bytes of an image that a slice checks, and words that one writes.
const BYTES_PER_SLICE: usize = 124;
const WORDS_PER_SLICE: usize = 64;

// Slices are whole: the checksum, shared with the dampers' images, need not ask for bytes that are not there.
const _: () = assert!((HealthModel::IMAGE_BYTES - CHECK_BYTES).is_multiple_of(BYTES_PER_SLICE));

/// Why bytes are no model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum HealthImageError {
    /// Cut short or too long.
    #[error("{found} bytes where a model of health has {expected}")]
    Length {
        /// Bytes of an image.
        expected: u32,
        /// Bytes there are.
        found: u32,
    },
    /// The first four bytes are not `DAHM`.
    #[error("not a model of health: must start with DAHM")]
    Magic,
    /// Another version of the format, the one found.
    #[error("format version {0}, must be {VERSION}")]
    Version(u32),
    /// The CRC-32 is not that of the bytes: damaged on the way.
    #[error("CRC-32 does not match: the bytes are damaged")]
    Checksum,
    /// Constants that no build makes: of another step than above 0, or of too short a block.
    #[error("constants that no build makes")]
    Values,
}

/// How far the loading of an image has come: a slice at a time, for a device between ticks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HealthLoading {
    slices: usize,
    crc: u32,
    words: usize,
}

/// The constants of an image that was checked whole.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedImage<'a>(&'a [[u8; 4]; WORDS]);

impl HealthLoading {
    /// Before the first slice.
    pub(crate) const START: Self = Self {
        slices: 0,
        crc: 0,
        words: 0,
    };

    /// Checks the next slice of an image; its constants once it was checked whole.
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
            && image.word(offset_of!(HealthModel, block_ticks)) >= FEWEST_TICKS
            && image.half_step_s() > 0.0
            && image.half_step_s().is_finite();
        possible
            .then_some(Some(image))
            .ok_or(HealthImageError::Values)
    }
}

impl HealthLoading {
    /// Whether nothing was written yet.
    #[cfg(feature = "link")]
    pub(crate) fn writes_nothing_yet(&self) -> bool {
        self.words == 0
    }

    /// Writes the next slice of checked constants to a model, in place: no copy of them on the stack. True with the
    /// last one.
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
    /// Bytes of an image of a model.
    pub const IMAGE_BYTES: usize = HEADER_BYTES + 4 * WORDS + CHECK_BYTES;

    /// No model: of zero bits, not marked.
    pub(crate) const EMPTY: Self = zerocopy::transmute!([0_u32; WORDS]);

    /// This model as bytes, baseline and limits with it.
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

    /// The model of an image, to the bit.
    ///
    /// # Errors
    /// The bytes are not those that [`Self::to_image`] of this version made.
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
