//! The header of an image.

use zerocopy::little_endian::{U16, U32};
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use super::ImageError;

const MAGIC: [u8; 4] = *b"DASH";
const BYTE_ORDER: u16 = 0xfeff;
/// Version of the format. It changes whenever the meaning of the words changes, or what the table requires of
/// them: since version 4 at most one knot lies within a bin.
pub(super) const VERSION: u16 = 4;

/// Header before the words.
#[derive(Clone, Copy, FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned)]
#[repr(C)]
pub(super) struct Header {
    magic: [u8; 4],
    byte_order: U16,
    version: U16,
    scalar_bytes: U32,
    image_bytes: U32,
}

impl Header {
    pub(super) const BYTES: usize = size_of::<Self>();

    /// Header of an image with a total of `image_bytes`.
    pub(super) fn new(scalar_bytes: usize, image_bytes: usize) -> Self {
        Self {
            magic: MAGIC,
            byte_order: BYTE_ORDER.into(),
            version: VERSION.into(),
            scalar_bytes: (scalar_bytes as u32).into(),
            image_bytes: (image_bytes as u32).into(),
        }
    }

    /// Checks that `image` starts with this header and has the length that the header states.
    ///
    /// # Errors
    /// The first difference.
    pub(super) fn check(&self, image: &[u8]) -> Result<(), ImageError> {
        let expected = self.image_bytes.get();
        let length = |found| ImageError::Length { expected, found };
        let bytes = u32::try_from(image.len()).unwrap_or(u32::MAX);
        let Ok((found, _)) = Self::ref_from_prefix(image) else {
            return Err(length(bytes));
        };
        if found.magic != self.magic {
            Err(ImageError::Magic)
        } else if found.byte_order != self.byte_order {
            Err(ImageError::ByteOrder)
        } else if found.version != self.version {
            Err(ImageError::Version(found.version.get()))
        } else if found.scalar_bytes != self.scalar_bytes {
            Err(ImageError::Scalar(found.scalar_bytes.get()))
        } else if found.image_bytes != self.image_bytes {
            Err(length(found.image_bytes.get()))
        } else if bytes != expected {
            Err(length(bytes))
        } else {
            Ok(())
        }
    }
}
