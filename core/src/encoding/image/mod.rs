//! A built damper as bytes: how a host hands one to firmware over a link, a file or a C program.
//!
//! | offset | bytes | holds |
//! |---|---|---|
//! | 0 | 4 | `DASH` |
//! | 4 | 2 | byte-order mark `0xfeff` |
//! | 6 | 2 | version of this format |
//! | 8 | 4 | bytes of a scalar, 4 or 8 |
//! | 12 | 4 | bytes of the whole image |
//! | 16 | | the words of [`Damper::to_words`](crate::Damper) |
//! | end - 4 | 4 | CRC-32 (ISO-HDLC, that of Ethernet and zip) of all bytes before |
//!
//! Every number is little-endian.

mod loading;

pub use loading::Loading;

use core::fmt;

use crate::damper::Damper;
use crate::encoding::checksum::crc_32;

const MAGIC: [u8; 4] = *b"DASH";
const BYTE_ORDER: u16 = 0xfeff;
/// Changes whenever the same words would mean another damper.
const VERSION: u16 = 2;
const HEADER_BYTES: usize = 16;
const CHECK_BYTES: usize = 4;

/// Why bytes are no damper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageError {
    /// Cut short, too long, or of a core with another table.
    Length {
        /// Bytes of an image.
        expected: usize,
        /// Bytes there are, or bytes the header states.
        found: usize,
    },
    /// The first four bytes are not `DASH`.
    Magic,
    /// The byte-order mark is not that of little-endian numbers.
    ByteOrder,
    /// Another version of the format, the one found.
    Version(u16),
    /// Another scalar; the bytes of the one found.
    Scalar(u32),
    /// The CRC-32 is not that of the bytes: damaged on the way.
    Checksum,
    /// A constant is not finite or out of range, or the revision is not that of the constants.
    Constants,
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { expected, found } => {
                write!(f, "{found} bytes where a damper has {expected}")
            }
            Self::Magic => f.write_str("not a damper: must start with DASH"),
            Self::ByteOrder => f.write_str("byte order is not little-endian"),
            Self::Version(found) => write!(f, "format version {found}, must be {VERSION}"),
            Self::Scalar(found) => write!(f, "scalar of {found} bytes is not this damper's"),
            Self::Checksum => f.write_str("CRC-32 does not match: the bytes are damaged"),
            Self::Constants => f.write_str("constants or revision that no build makes"),
        }
    }
}

impl core::error::Error for ImageError {}

/// Header of an image of `length` bytes.
fn header(scalar_bytes: usize, length: usize) -> [u8; HEADER_BYTES] {
    let mut header = [0; HEADER_BYTES];
    let fields = MAGIC
        .into_iter()
        .chain(BYTE_ORDER.to_le_bytes())
        .chain(VERSION.to_le_bytes())
        .chain((scalar_bytes as u32).to_le_bytes())
        .chain((length as u32).to_le_bytes());
    for (byte, field) in header.iter_mut().zip(fields) {
        *byte = field;
    }
    header
}

macro_rules! image {
    ($float:ident, $word:ident) => {
        impl Damper<$float> {
            /// Bytes of an image of a damper.
            pub const IMAGE_BYTES: usize =
                HEADER_BYTES + Self::WORDS * size_of::<$word>() + CHECK_BYTES;

            /// This damper as bytes, checked by [`Self::load_image`].
            pub fn to_image(&self) -> [u8; Self::IMAGE_BYTES] {
                let mut image = [0; Self::IMAGE_BYTES];
                let words = self.to_words();
                let bytes = header(size_of::<$word>(), Self::IMAGE_BYTES)
                    .into_iter()
                    .chain(words.iter().flat_map(|word| word.to_le_bytes()));
                for (place, byte) in image.iter_mut().zip(bytes) {
                    *place = byte;
                }
                if let Some((checked, check)) = image.split_last_chunk_mut::<CHECK_BYTES>() {
                    *check = crc_32(checked).to_le_bytes();
                }
                image
            }

            /// The damper of an image.
            ///
            /// # Errors
            /// Those of [`Self::load_image`].
            ///
            /// ```
            /// use dashpot_core::{Damper, ImageError};
            #[doc = concat!("let found = Damper::<", stringify!($float), ">::from_image(b\"DASH\");")]
            #[doc = concat!("let expected = Damper::<", stringify!($float), ">::IMAGE_BYTES;")]
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
