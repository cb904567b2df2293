//! A built damper as bytes, for a link, a file or a C program.
//!
//! | offset | bytes | holds |
//! |---|---|---|
//! | 0 | 4 | `DASH` |
//! | 4 | 2 | byte-order mark `0xfeff` |
//! | 6 | 2 | version of this format |
//! | 8 | 4 | bytes of a scalar, 4 or 8 |
//! | 12 | 4 | bytes of the whole image |
//! | 16 | | the words of [`Damper::to_words`](crate::Damper) |
//! | end - 4 | 4 | CRC-32 (ISO-HDLC, as in Ethernet and zip) of all bytes before |
//!
//! All numbers are little-endian.

mod header;
mod loading;

use header::{Header, VERSION};
pub use loading::Loading;
use zerocopy::IntoBytes;

use crate::checksum::crc_32;
use crate::damper::Damper;

/// Number of bytes of the CRC-32.
const CHECK_BYTES: usize = 4;

/// Errors of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ImageError {
    /// The bytes are truncated, too long, or from a core with another table.
    #[error("{found} bytes, but a damper has {expected}")]
    Length {
        /// Number of bytes of an image.
        expected: u32,
        /// Number of bytes found, or stated in the header.
        found: u32,
    },
    /// The first four bytes are not `DASH`.
    #[error("not a damper: must start with DASH")]
    Magic,
    /// The byte-order mark is not little-endian.
    #[error("byte order is not little-endian")]
    ByteOrder,
    /// The image has a different format version, given here.
    #[error("format version {0}, must be {VERSION}")]
    Version(u16),
    /// The image is for a scalar of another size, which has this many bytes.
    #[error("wrong precision: each number has {0} bytes")]
    Scalar(u32),
    /// The CRC-32 does not match: the bytes are damaged.
    #[error("CRC-32 does not match: the bytes are damaged")]
    Checksum,
    /// A number in the table's piece with this index (from 0) is not finite.
    #[error("piece {0} of the table has a number that is not finite")]
    Piece(u32),
    /// The revision does not match the constants, so no build produced them.
    #[error("the revision does not match the constants: no build produced them")]
    Revision,
    /// A constant outside the table is not finite or is out of range.
    #[error("a constant outside the table is not finite or out of range")]
    Scalars,
}

macro_rules! image {
    ($float:ident, $word:ident) => {
        impl Damper<$float> {
            /// Number of bytes of an image.
            pub const IMAGE_BYTES: usize =
                Header::BYTES + Self::WORDS * size_of::<$word>() + CHECK_BYTES;

            /// Returns this damper as bytes with a checksum, for [`Self::load_image`].
            pub fn to_image(&self) -> [u8; Self::IMAGE_BYTES] {
                let mut image = [0; Self::IMAGE_BYTES];
                let words = self.to_words();
                let header = Header::new(size_of::<$word>(), Self::IMAGE_BYTES);
                let header = header.as_bytes().iter().copied();
                let bytes = header.chain(words.iter().flat_map(|word| word.to_le_bytes()));
                for (to, byte) in image.iter_mut().zip(bytes) {
                    *to = byte;
                }
                if let Some((checked, check)) = image.split_last_chunk_mut::<CHECK_BYTES>() {
                    *check = crc_32(checked).to_le_bytes();
                }
                image
            }

            /// Returns the damper of an image.
            ///
            /// # Errors
            /// The first error in the image.
            ///
            /// ```
            /// use dashpot_core::{Damper, ImageError};
            #[doc = concat!("let found = Damper::<", stringify!($float), ">::from_image(b\"DASH\");")]
            #[doc = concat!("let expected = Damper::<", stringify!($float), ">::IMAGE_BYTES as u32;")]
            /// assert_eq!(found, Err(ImageError::Length { expected, found: 4 }));
            /// ```
            pub fn from_image(image: &[u8]) -> Result<Self, ImageError> {
                let mut damper = Self::from_words(&[0; Self::WORDS]);
                damper.load_image(image)?;
                Ok(damper)
            }
        }
    };
}

image!(f32, u32);
image!(f64, u64);
