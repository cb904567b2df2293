//! A built damper as plain words: constants for firmware.

use crate::damper::Damper;
use crate::scalars::{SCALARS, Scalars};
use crate::table::{BUILT_NUMBERS, FLOW, KNOTS, PIECES, POTENTIAL, STIFFNESS, Table};

/// Number of words of a damper: scalars, two revisions and the pieces of the table.
const WORDS: usize = TABLE + 2 * PIECES * PIECE;
/// Number of words before the table.
pub(crate) const TABLE: usize = SCALARS + 2;
/// Number of words of a piece.
pub(crate) const PIECE: usize = BUILT_NUMBERS;

macro_rules! words {
    ($float:ident, $word:ident) => {
        #[doc = concat!("Each word contains the bits of an `", stringify!($float), "` as `", stringify!($word), "`; \
         the revisions are zero-extended.")]
        impl Damper<$float> {
            /// Number of words of a damper.
            pub const WORDS: usize = WORDS;

            /// Returns the damper of these words. Also works at compile time and without the `builder` feature.
            ///
            /// Order: scalars, revision, revision of the table, pieces. Each piece has four coefficients of the flow,
            /// four of the potential and four of the stiffness, then its knot. Words that are not from
            /// [`Self::to_words`] of this version are safe, but give meaningless forces.
            ///
            /// ```
            /// use dashpot_core::Damper;
            #[doc = concat!("static DAMPER: Damper<", stringify!($float), "> =")]
            #[doc = concat!("    Damper::<", stringify!($float), ">::from_words(&[0; \
             Damper::<", stringify!($float), ">::WORDS]);")]
            /// assert_eq!(DAMPER.revision(), 0); // all zero: no damper was built
            /// assert_eq!(DAMPER.step(&mut DAMPER.at_rest(0.0), 1e-3), 0.0);
            /// ```
            pub const fn from_words(words: &[$word; WORDS]) -> Self {
                const fn cubic(words: &[$word; WORDS], from: usize) -> [$float; 4] {
                    [
                        $float::from_bits(words[from]),
                        $float::from_bits(words[from + 1]),
                        $float::from_bits(words[from + 2]),
                        $float::from_bits(words[from + 3]),
                    ]
                }
                let mut table = Table::<$float>::ZERO;
                let mut scalars = [0.0; SCALARS];
                let mut index = 0;
                while index < SCALARS {
                    scalars[index] = $float::from_bits(words[index]);
                    index += 1;
                }
                index = 0;
                while index < 2 * PIECES {
                    let from = TABLE + PIECE * index;
                    let piece = &mut table.pieces[index];
                    piece[FLOW] = cubic(words, from);
                    piece[POTENTIAL] = cubic(words, from + 4);
                    piece[STIFFNESS] = cubic(words, from + 8);
                    piece[KNOTS][0] = $float::from_bits(words[from + 12]);
                    index += 1;
                }
                table.index();
                let table_check = table.check();
                Self {
                    scalars: Scalars::from_array(scalars),
                    revision: words[SCALARS] as u32,
                    table_revision: words[SCALARS + 1] as u32,
                    table_check,
                    padding: [0; 2],
                    table,
                }
            }

            /// Returns the words of this damper, from which [`Self::from_words`] restores it exactly.
            pub fn to_words(&self) -> [$word; WORDS] {
                let revisions = [self.revision, self.table_revision].map($word::from);
                let numbers = self.table.built_numbers();
                let scalars = self.scalars.as_array().map($float::to_bits);
                let all = scalars.into_iter().chain(revisions).chain(numbers.map(|number| number.to_bits()));
                let mut words = [0; WORDS];
                for (word, value) in words.iter_mut().zip(all) {
                    *word = value;
                }
                words
            }
        }
    };
}

words!(f32, u32);
words!(f64, u64);

#[cfg(feature = "link")]
impl Damper<f32> {
    /// Placeholder until a damper is loaded: all bits are zero, so a static variable takes no flash.
    pub(crate) const EMPTY: Self = Self {
        scalars: Scalars::from_array([0.0; SCALARS]),
        revision: 0,
        table_revision: 0,
        table_check: 0,
        padding: [0; 2],
        table: Table::<f32>::ZERO,
    };
}

#[cfg(test)]
mod tests {
    use super::{KNOTS, PIECES, WORDS};
    use crate::Damper;

    /// Tests with words that are all different and not NaN: 1.0 and the following numbers.
    macro_rules! check_order_of_words {
        ($float:ident, $word:ident) => {
            let first = $float::to_bits(1.0);
            let words: [$word; WORDS] = core::array::from_fn(|index| first + index as $word);
            let damper = Damper::<$float>::from_words(&words);
            let mut expected = words;
            // Revisions have 32 bits.
            for index in [11, 12] {
                expected[index] = $word::from(words[index] as u32);
            }
            assert_eq!(damper.to_words(), expected);
            assert_eq!(damper.step_s().to_bits(), words[3]);
            assert_eq!((0.5 * damper.force_limit_n()).to_bits(), words[7]);
            assert_eq!(damper.revision(), words[11] as u32);
            assert_eq!(
                damper.table.pieces[2 * PIECES - 1][KNOTS][0].to_bits(),
                words[WORDS - 1]
            );
        };
    }

    #[test]
    fn f32_words_are_in_order() {
        check_order_of_words!(f32, u32);
    }

    #[test]
    fn f64_words_are_in_order() {
        check_order_of_words!(f64, u64);
    }

    #[cfg(feature = "builder")]
    #[test]
    fn words_restore_a_built_damper() {
        let parameters = crate::example::reduced_vertical();
        let single: Damper<f32> = parameters.build(1e-3).unwrap();
        assert_eq!(Damper::<f32>::from_words(&single.to_words()), single);
        let double: Damper<f64> = parameters.build(1e-4).unwrap();
        assert_eq!(Damper::<f64>::from_words(&double.to_words()), double);
    }
}
