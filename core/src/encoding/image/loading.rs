//! Loads a damper from an image in slices of bounded work. Nothing is written before the whole image is verified.

use super::super::words::{PIECE, TABLE};
use super::header::Header;
use super::{CHECK_BYTES, ImageError};
use crate::checksum;
use crate::damper::Damper;
use crate::parameters::{Limits, MAX_CLEARANCE_M, MAX_FORCE_N, Range};
use crate::revision;
use crate::scalars::{SCALARS, Scalars};
use crate::table::{INDEX_SLICES, ROWS};

/// Progress of loading an image, for [`Damper::load_slice`](crate::Damper).
#[derive(Clone, Copy, Debug)]
pub struct Loading(Stage);

impl Loading {
    /// Loading before the first slice.
    pub const START: Self = Self(Stage::Checksum { bytes: 0, crc: 0 });
}

/// Work of the next slice.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Continue the CRC-32 of the bytes.
    Checksum { bytes: usize, crc: u32 },
    /// Continue the hash of the pieces and check that all numbers are finite.
    Verify { piece: usize, hash: u32 },
    /// Write the next piece.
    Write { piece: usize },
    /// Build the next slice of the bins, starting at this piece.
    Index { slice: usize, piece: usize },
    /// Continue the CRC-32 of the rows of the table.
    Check { row: usize, crc: u32 },
}

/// Allowed range of the largest displacement.
const DISPLACEMENTS_M: Range = Limits::RANGES.displacement_m;

/// Number of bytes of an image that one slice checks.
const BYTES_PER_SLICE: usize = 64;
/// Number of rows of the table that one slice checks.
const ROWS_PER_SLICE: usize = 8;

macro_rules! loading {
    ($float:ident, $word:ident) => {
        impl Damper<$float> {
            /// Replaces this damper with that of an image, without a copy on the stack. The next step adopts states of
            /// the old damper.
            ///
            /// # Errors
            /// The first error in the image; the damper is unchanged.
            pub fn load_image(&mut self, image: &[u8]) -> Result<(), ImageError> {
                let mut loading = Loading::START;
                while !self.load_slice(image, &mut loading)? {}
                Ok(())
            }

            /// Loads the next slice of an image, which takes at most a few thousand operations, so that ticks can run
            /// between slices.
            ///
            /// Call it with the same image and damper until it returns true. Do not step the damper until then, or
            /// after an error.
            ///
            /// # Errors
            /// The first error in the image.
            ///
            /// ```
            /// # #[cfg(feature = "builder")] {
            /// use dashpot_core::parameters::{DamperParameters, Mount};
            /// use dashpot_core::{Damper, Loading};
            ///
            /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
            #[doc = concat!("let built: Damper<", stringify!($float), "> = parameters.build(1e-3)?;")]
            /// let image = built.to_image();
            #[doc = concat!("let mut damper = Damper::<", stringify!($float), ">::from_words(&[0; \
             Damper::<", stringify!($float), ">::WORDS]);")]
            /// let mut loading = Loading::START;
            /// while !damper.load_slice(&image, &mut loading).unwrap() {
            ///     // a tick can run here
            /// }
            /// assert_eq!(damper, built);
            /// # }
            /// # Ok::<(), dashpot_core::BuildError>(())
            /// ```
            pub fn load_slice(&mut self, image: &[u8], loading: &mut Loading) -> Result<bool, ImageError> {
                const BYTES: usize = size_of::<$float>();
                loading.0 = match loading.0 {
                    Stage::Checksum { .. } | Stage::Verify { .. } => Self::verify_slice(image, loading.0)?,
                    Stage::Write { piece } => {
                        match (Words::<BYTES>::of(image).piece(piece), self.table.pieces.get_mut(piece)) {
                            (Some(words), Some(target)) => {
                                for (number, word) in target.as_flattened_mut().iter_mut().zip(words) {
                                    *number = $float::from_le_bytes(*word);
                                }
                                Stage::Write { piece: piece + 1 }
                            }
                            _ => Stage::Index { slice: 0, piece: 0 },
                        }
                    }
                    Stage::Index { slice, piece } if slice < INDEX_SLICES => {
                        let piece = self.table.index_slice(slice, piece);
                        Stage::Index { slice: slice + 1, piece }
                    }
                    Stage::Index { .. } => Stage::Check { row: 0, crc: 0 },
                    Stage::Check { row, crc } if row < ROWS => {
                        let rows = row..row + ROWS_PER_SLICE;
                        let crc = rows.fold(crc, |crc, row| self.table.check_row(row, crc));
                        Stage::Check { row: row + ROWS_PER_SLICE, crc }
                    }
                    Stage::Check { crc, .. } => {
                        let (scalars, revisions) = Self::read_scalars(image)?;
                        self.scalars = scalars;
                        [self.revision, self.table_revision] = revisions.map(|word| word as u32);
                        self.table_check = crc;
                        return Ok(true);
                    }
                };
                Ok(false)
            }

            /// Checks an image without loading it. Returns the progress from which [`Self::load_slice`] continues.
            ///
            /// # Errors
            /// The first error in the image.
            pub fn check_image(image: &[u8]) -> Result<Loading, ImageError> {
                let mut stage = Loading::START.0;
                while matches!(stage, Stage::Checksum { .. } | Stage::Verify { .. }) {
                    stage = Self::verify_slice(image, stage)?;
                }
                Ok(Loading(stage))
            }

            /// Reads the scalars of an image and the revisions of damper and table that it states.
            fn read_scalars(image: &[u8]) -> Result<(Scalars<$float>, [$word; 2]), ImageError> {
                let words = Words::<{ size_of::<$float>() }>::of(image);
                let both = words.scalars().zip(words.revisions());
                let (scalars, revisions) = both.ok_or(ImageError::Scalars)?;
                let scalars = Scalars::from_array(scalars.map($float::from_le_bytes));
                Ok((scalars, revisions.map($word::from_le_bytes)))
            }

            /// Runs a slice that only reads, and returns the next stage.
            fn verify_slice(image: &[u8], stage: Stage) -> Result<Stage, ImageError> {
                const BYTES: usize = size_of::<$float>();
                let number = |word: &[u8; BYTES]| $float::from_le_bytes(*word);
                match stage {
                    Stage::Checksum { bytes, crc } => {
                        let body = open(image, &Header::new(BYTES, Self::IMAGE_BYTES))?;
                        let left = body.checked.get(bytes..).unwrap_or_default();
                        let slice = left.get(..BYTES_PER_SLICE).unwrap_or(left);
                        if !slice.is_empty() {
                            let crc = checksum::continued(crc, slice);
                            Ok(Stage::Checksum { bytes: bytes + slice.len(), crc })
                        } else if crc == body.stated {
                            Ok(Stage::Verify { piece: 0, hash: revision::START })
                        } else {
                            Err(ImageError::Checksum)
                        }
                    }
                    Stage::Verify { piece, hash } => {
                        let words = Words::<BYTES>::of(image);
                        if let Some(coefficients) = words.piece(piece) {
                            if !coefficients.iter().all(|word| number(word).is_finite()) {
                                return Err(ImageError::Piece(piece as u32));
                            }
                            let widened = coefficients.iter().map(|word| number(word).to_bits().into());
                            let hash = revision::of_words(hash, widened);
                            return Ok(Stage::Verify { piece: piece + 1, hash });
                        }
                        let (scalars, revisions) = Self::read_scalars(image)?;
                        let revision = revision::of_damper(hash, &scalars);
                        let credible = scalars.as_array().iter().all(|scalar| scalar.is_finite() && *scalar >= 0.0)
                            && scalars.step_s > 0.0
                            && scalars.move_bound > 0.0
                            && scalars.half_clearance <= (0.5 * MAX_CLEARANCE_M) as $float
                            && scalars.half_force_limit <= (0.5 * MAX_FORCE_N) as $float
                            && scalars.first_knot > 0.0
                            && scalars.offset == scalars.half_clearance + scalars.held
                            && (DISPLACEMENTS_M.min as $float..=DISPLACEMENTS_M.max as $float)
                                .contains(&scalars.max_displacement())
                            && scalars.stretch_bound == scalars.computed_stretch_bound();
                        if revisions != [revision, hash].map($word::from) {
                            Err(ImageError::Revision)
                        } else if !credible {
                            Err(ImageError::Scalars)
                        } else {
                            Ok(Stage::Write { piece: 0 })
                        }
                    }
                    done => Ok(done),
                }
            }
        }
    };
}

/// Bytes that the CRC-32 of an image covers, and the CRC-32 stated in the image.
struct Body<'a> {
    checked: &'a [u8],
    stated: u32,
}

/// Checks header and length of an image and returns its body.
fn open<'a>(image: &'a [u8], header: &Header) -> Result<Body<'a>, ImageError> {
    header.check(image)?;
    // The length is correct, so there are enough bytes for the CRC-32.
    let (checked, stated) = image
        .split_last_chunk()
        .unwrap_or((image, &[0; CHECK_BYTES]));
    let stated = u32::from_le_bytes(*stated);
    Ok(Body { checked, stated })
}

/// The words of an image.
struct Words<'a, const BYTES: usize>(&'a [[u8; BYTES]]);

impl<'a, const BYTES: usize> Words<'a, BYTES> {
    fn of(image: &'a [u8]) -> Self {
        let end = image.len().saturating_sub(CHECK_BYTES);
        let words = image.get(Header::BYTES..end).unwrap_or_default();
        Self(words.as_chunks().0)
    }

    /// Returns the scalars.
    fn scalars(&self) -> Option<&'a [[u8; BYTES]; SCALARS]> {
        self.0.first_chunk()
    }

    /// Returns the revisions of damper and table.
    fn revisions(&self) -> Option<&'a [[u8; BYTES]; 2]> {
        self.0.get(SCALARS..)?.first_chunk()
    }

    /// Returns the numbers of a piece.
    fn piece(&self, piece: usize) -> Option<&'a [[u8; BYTES]; PIECE]> {
        self.0.get(TABLE + PIECE * piece..)?.first_chunk()
    }
}

loading!(f32, u32);
loading!(f64, u64);
