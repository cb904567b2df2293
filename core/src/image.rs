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

use core::fmt;

use crate::checksum::crc_32;
use crate::damper::{Damper, SCALARS, Scalars};
use crate::parameters::LARGEST_CLEARANCE_M;
use crate::revision;
use crate::table::Piece;

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

/// The words of an image of `expected` bytes whose header, length and CRC-32 are right.
fn body(bytes: &[u8], scalar_bytes: usize, expected: usize) -> Result<&[u8], ImageError> {
    let length = |found| ImageError::Length { expected, found };
    let whole = bytes
        .split_last_chunk::<CHECK_BYTES>()
        .and_then(|(checked, check)| {
            let (header, body) = checked.split_first_chunk::<HEADER_BYTES>()?;
            Some((header, body, checked, check))
        });
    let (header, body, checked, check) = whole.ok_or(length(bytes.len()))?;
    let [
        m0,
        m1,
        m2,
        m3,
        o0,
        o1,
        v0,
        v1,
        s0,
        s1,
        s2,
        s3,
        l0,
        l1,
        l2,
        l3,
    ] = *header;
    let version = u16::from_le_bytes([v0, v1]);
    let scalar = u32::from_le_bytes([s0, s1, s2, s3]);
    let stated = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
    if [m0, m1, m2, m3] != MAGIC {
        Err(ImageError::Magic)
    } else if u16::from_le_bytes([o0, o1]) != BYTE_ORDER {
        Err(ImageError::ByteOrder)
    } else if version != VERSION {
        Err(ImageError::Version(version))
    } else if scalar as usize != scalar_bytes {
        Err(ImageError::Scalar(scalar))
    } else if stated != expected {
        Err(length(stated))
    } else if bytes.len() != expected {
        Err(length(bytes.len()))
    } else if crc_32(checked) != u32::from_le_bytes(*check) {
        Err(ImageError::Checksum)
    } else {
        Ok(body)
    }
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

            /// Makes this the damper of an image, in place: no copy of it on the stack. A state that
            /// this damper stepped before is carried over at its next step.
            ///
            /// # Errors
            /// The first fault found, from the front of the image; the damper is then as it was.
            pub fn load_image(&mut self, image: &[u8]) -> Result<(), ImageError> {
                let constants = Constants::<$float, _>::read(image)?;
                self.scalars = constants.scalars;
                self.revision = constants.revision;
                self.table_revision = constants.table_revision;
                let places = self.table.pieces.iter_mut().flat_map(Piece::numbers_mut);
                for (place, word) in places.zip(constants.coefficients) {
                    *place = $float::from_le_bytes(*word);
                }
                self.table.index();
                self.table_check = self.table.check();
                Ok(())
            }

            /// Whether an image is a damper, without taking it.
            ///
            /// # Errors
            /// Those of [`Self::load_image`].
            pub fn check_image(image: &[u8]) -> Result<(), ImageError> {
                Constants::<$float, _>::read(image).map(drop)
            }
        }

        impl<'a> Constants<'a, $float, { size_of::<$float>() }> {
            fn read(image: &'a [u8]) -> Result<Self, ImageError> {
                const BYTES: usize = size_of::<$float>();
                let body = body(image, BYTES, Damper::<$float>::IMAGE_BYTES)?;
                let (words, _) = body.as_chunks::<BYTES>();
                let parts = words
                    .split_first_chunk::<SCALARS>()
                    .and_then(|(scalars, rest)| Some((scalars, rest.split_first_chunk::<2>()?)));
                let Some((scalars, (revisions, coefficients))) = parts else {
                    return Err(ImageError::Constants);
                };
                let number = |word: &[u8; BYTES]| $float::from_le_bytes(*word);
                let finite = scalars.iter().chain(coefficients).all(|word| number(word).is_finite());
                let scalars = Scalars::from_array(scalars.map(|word| number(&word)));
                let widened = coefficients.iter().map(|word| number(word).to_bits().into());
                let table_revision = revision::of_words(revision::START, widened);
                let revision = revision::of_damper(table_revision, &scalars);
                let credible = scalars.as_array().iter().all(|scalar| *scalar >= 0.0)
                    && scalars.step_s > 0.0
                    && scalars.largest_move > 0.0
                    && scalars.half_clearance <= (0.5 * LARGEST_CLEARANCE_M) as $float
                    && scalars.first_knot > 0.0
                    && scalars.offset == scalars.half_clearance + scalars.held;
                if revisions.map($word::from_le_bytes) == [revision, table_revision].map($word::from)
                    && finite
                    && credible
                {
                    Ok(Self { scalars, revision, table_revision, coefficients })
                } else {
                    Err(ImageError::Constants)
                }
            }
        }
    };
}

/// What an image holds, checked.
struct Constants<'a, T, const BYTES: usize> {
    scalars: Scalars<T>,
    revision: u32,
    table_revision: u32,
    coefficients: &'a [[u8; BYTES]],
}

image!(f32, u32);
image!(f64, u64);
