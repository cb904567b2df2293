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

use super::model::HealthModel;
use crate::encoding::crc_32;

const MAGIC: [u8; 4] = *b"DAHM";
/// Changes whenever the same bytes would mean another model.
const VERSION: u32 = 1;
const HEADER_BYTES: usize = 8;
const CHECK_BYTES: usize = 4;
/// Words of a model.
const WORDS: usize = size_of::<HealthModel>() / 4;

/// Why bytes are no model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HealthImageError {
    /// Cut short or too long.
    #[error("{found} bytes where a model of health has {expected}")]
    Length {
        /// Bytes of an image.
        expected: usize,
        /// Bytes there are.
        found: usize,
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
}

impl HealthModel {
    /// Bytes of an image of a model.
    pub const IMAGE_BYTES: usize = HEADER_BYTES + 4 * WORDS + CHECK_BYTES;

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
        let length = HealthImageError::Length {
            expected: Self::IMAGE_BYTES,
            found: image.len(),
        };
        let image: &[u8; Self::IMAGE_BYTES] = image.try_into().map_err(|_| length)?;
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
        if crc_32(checked) != u32::from_le_bytes(*check) {
            return Err(HealthImageError::Checksum);
        }
        let mut numbers = [0; WORDS];
        for (number, bytes) in numbers.iter_mut().zip(words.as_chunks().0) {
            *number = u32::from_le_bytes(*bytes);
        }
        Ok(zerocopy::transmute!(numbers))
    }
}
