//! A damper from an image, in slices of bounded work. Nothing is written before everything is verified.

use super::super::words::{PIECE, TABLE};
use super::header::Header;
use super::{CHECK_BYTES, ImageError};
use crate::damper::Damper;
use crate::encoding::{checksum, revision};
use crate::parameters::{LARGEST_CLEARANCE_M, LARGEST_FORCE_N, Limits, Range};
use crate::scalars::{SCALARS, Scalars};
use crate::table::{INDEX_SLICES, ROWS};

/// How far the loading of an image has come: see [`Damper::load_slice`](crate::Damper).
#[derive(Clone, Copy, Debug)]
pub struct Loading(Stage);

impl Loading {
    /// Before the first slice.
    pub const START: Self = Self(Stage::Checksum { bytes: 0, crc: 0 });
}

/// What the next slice does.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// CRC-32 of the bytes so far.
    Checksum { bytes: usize, crc: u32 },
    /// Hash of the pieces so far, each number of them finite.
    Verify { piece: usize, hash: u32 },
    /// Pieces written so far.
    Write { piece: usize },
    /// Slices of the index so far, and the piece they came to.
    Index { slice: usize, piece: usize },
    /// CRC-32 of the rows of the table so far.
    Check { row: usize, crc: u32 },
}

/// Range of the largest displacement.
const DISPLACEMENTS_M: Range = Limits::RANGES.displacement_m;

/// Bytes of an image in a slice.
const BYTES_PER_SLICE: usize = 64;
/// Rows of the table in a slice.
const ROWS_PER_SLICE: usize = 8;

macro_rules! loading {
    ($float:ident, $word:ident) => {
        impl Damper<$float> {
            /// Makes this the damper of an image, in place: no copy of it on the stack. A state that
            /// this damper stepped before is carried over at its next step.
            ///
            /// # Errors
            /// The first fault found, from the front of the image; the damper is then as it was.
            pub fn load_image(&mut self, image: &[u8]) -> Result<(), ImageError> {
                let mut loading = Loading::START;
                while !self.load_slice(image, &mut loading)? {}
                Ok(())
            }

            /// [`Self::load_image`] in slices of some thousand operations at most, for a program that has a tick to
            /// serve between them: call it with the same image and damper until it returns true. Until then, and
            /// after an error, the damper is not to be stepped.
            ///
            /// # Errors
            /// As [`Self::load_image`].
            ///
            /// ```
            /// # #[cfg(feature = "builder")] {
            /// use dashpot_core::parameters::{DamperParameters, Mount};
            /// use dashpot_core::{Damper, Loading};
            ///
            /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
            #[doc = concat!("let built: Damper<", stringify!($float), "> = parameters.build(1e-3)?;")]
            /// let image = built.to_image();
            #[doc = concat!("let mut damper = Damper::<", stringify!($float), ">::from_words(&[0; Damper::<", stringify!($float), ">::WORDS]);")]
            /// let mut loading = Loading::START;
            /// while !damper.load_slice(&image, &mut loading).unwrap() {
            ///     // a tick may run here
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
                            (Some(words), Some(place)) => {
                                for (number, word) in place.numbers_mut().zip(words) {
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

            /// Whether an image is a damper, without taking it; where [`Self::load_slice`] goes on with it.
            ///
            /// # Errors
            /// Those of [`Self::load_image`].
            pub fn check_image(image: &[u8]) -> Result<Loading, ImageError> {
                let mut stage = Loading::START.0;
                while matches!(stage, Stage::Checksum { .. } | Stage::Verify { .. }) {
                    stage = Self::verify_slice(image, stage)?;
                }
                Ok(Loading(stage))
            }

            /// The scalars of an image, and the revisions it states of damper and table.
            fn read_scalars(image: &[u8]) -> Result<(Scalars<$float>, [$word; 2]), ImageError> {
                let words = Words::<{ size_of::<$float>() }>::of(image);
                let both = words.scalars().zip(words.revisions());
                let (scalars, revisions) = both.ok_or(ImageError::Scalars)?;
                let scalars = Scalars::from_array(scalars.map($float::from_le_bytes));
                Ok((scalars, revisions.map($word::from_le_bytes)))
            }

            /// What comes after a stage that only reads.
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
                            && scalars.half_clearance <= (0.5 * LARGEST_CLEARANCE_M) as $float
                            && scalars.half_force_limit <= (0.5 * LARGEST_FORCE_N) as $float
                            && scalars.first_knot > 0.0
                            && scalars.offset == scalars.half_clearance + scalars.held
                            && (DISPLACEMENTS_M.least as $float..=DISPLACEMENTS_M.greatest as $float)
                                .contains(&scalars.largest_displacement())
                            && scalars.stretch_bound == scalars.stretch_bound_by_others();
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

/// What the CRC-32 of an image is of, and what it is.
struct Body<'a> {
    checked: &'a [u8],
    stated: u32,
}

/// An image whose header and length are right.
fn open<'a>(image: &'a [u8], header: &Header) -> Result<Body<'a>, ImageError> {
    header.check(image)?;
    // The header is there, and so are more bytes than the check has.
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

    /// The scalars.
    fn scalars(&self) -> Option<&'a [[u8; BYTES]; SCALARS]> {
        self.0.first_chunk()
    }

    /// The damper's revision and its table's.
    fn revisions(&self) -> Option<&'a [[u8; BYTES]; 2]> {
        self.0.get(SCALARS..)?.first_chunk()
    }

    /// The numbers of a piece.
    fn piece(&self, piece: usize) -> Option<&'a [[u8; BYTES]; PIECE]> {
        self.0.get(TABLE + PIECE * piece..)?.first_chunk()
    }
}

loading!(f32, u32);
loading!(f64, u64);
