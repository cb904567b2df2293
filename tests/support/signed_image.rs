//! Computes the checksums of a damper's image from the documented format, without the code under test. A changed image
//! with these checksums is accepted as a damper.

use dashpot_core::Damper;

/// Bytes before the words.
const HEADER: usize = 16;
/// Indices of scalars, in words. The stretch up to which nothing flows is half the clearance plus the held stretch; it
/// determines the bound of the stretch, together with the first knot and the bound of moves.
const MOVE_BOUND: usize = 0;
const OFFSET: usize = 4;
const FIRST_KNOT: usize = 5;
const HALF_CLEARANCE: usize = 6;
const HELD: usize = 8;
const STRETCH_BOUND: usize = 10;
/// Scalars before the revision.
pub const SCALARS: usize = 11;
/// Words before the table: scalars, revision, revision of the table.
pub const TABLE: usize = SCALARS + 2;

/// CRC-32 as in ISO 3309, one bit at a time: reflected polynomial 0xedb88320, all ones before and after.
pub fn crc_32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 * (crc & 1))
        })
    })
}

/// FNV-1a (32 bit) of words widened to 64 bits, continued from `hash`.
fn fnv_1a(hash: u32, words: impl IntoIterator<Item = u64>) -> u32 {
    let bytes = words.into_iter().flat_map(u64::to_le_bytes);
    bytes.fold(hash, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(16_777_619)
    })
}

/// A scalar type of dampers, stored as words in an image.
pub trait Word: Copy {
    /// Bytes of a word.
    const BYTES: usize;
    /// An image with valid header and length whose words are all zero.
    fn empty() -> Vec<u8>;
    /// The bits of a word's bytes.
    fn bits(bytes: &[u8]) -> u64;
    /// The bytes of the sum of two numbers.
    fn sum(left: &[u8], right: &[u8]) -> Vec<u8>;
    /// The bytes of the bound of the stretch: the offset plus 0.7 times the length of the table less 1.12 moves,
    /// limited to 0 to 1.45 m. A bound is stored as the bits of its value, shifted left by one.
    fn stretch_bound(offset: &[u8], first_knot: &[u8], move_bound: &[u8]) -> Vec<u8>;
}

macro_rules! word {
    ($float:ident, $bits:ident) => {
        impl Word for $float {
            const BYTES: usize = size_of::<$float>();

            fn empty() -> Vec<u8> {
                const WORDS: usize = Damper::<$float>::WORDS;
                Damper::<$float>::from_words(&[0; WORDS]).to_image().into()
            }

            fn bits(bytes: &[u8]) -> u64 {
                $bits::from_le_bytes(bytes.try_into().expect("a word")).into()
            }

            fn sum(left: &[u8], right: &[u8]) -> Vec<u8> {
                let number =
                    |bytes: &[u8]| $float::from_le_bytes(bytes.try_into().expect("a word"));
                (number(left) + number(right)).to_le_bytes().into()
            }

            fn stretch_bound(offset: &[u8], first_knot: &[u8], move_bound: &[u8]) -> Vec<u8> {
                let number =
                    |bytes: &[u8]| $float::from_le_bytes(bytes.try_into().expect("a word"));
                let largest_move = $float::from_bits(number(move_bound).to_bits() >> 1);
                let most = 65_536.0 * number(first_knot) - (1.12 as $float) * largest_move;
                let stretch = number(offset) + (0.7 as $float) * most;
                let within = if stretch > 0.0 {
                    stretch.min(1.45)
                } else {
                    0.0
                };
                (within.to_bits() << 1).to_le_bytes().into()
            }
        }
    };
}

word!(f32, u32);
word!(f64, u64);

/// The bytes of a word of an image.
pub fn word<T: Word>(image: &mut [u8], index: usize) -> &mut [u8] {
    &mut image[HEADER + index * T::BYTES..][..T::BYTES]
}

/// Corrects the CRC-32 of an image.
pub fn sign(image: &mut [u8]) {
    let end = image.len() - 4;
    let check = crc_32(&image[..end]);
    image[end..].copy_from_slice(&check.to_le_bytes());
}

/// Corrects both revisions of an image, then its CRC-32.
pub fn revise_and_sign<T: Word>(image: &mut [u8]) {
    let end = image.len() - 4;
    let words = |from: usize, to: usize| image[from..to].chunks_exact(T::BYTES).map(T::bits);
    let [scalars_end, table] = [SCALARS, TABLE].map(|words| HEADER + words * T::BYTES);
    let of_table = fnv_1a(2_166_136_261, words(table, end));
    let revision = fnv_1a(of_table, words(HEADER, scalars_end)).max(1);
    for (index, revision) in [(SCALARS, revision), (SCALARS + 1, of_table)] {
        let bytes = u64::from(revision).to_le_bytes();
        word::<T>(image, index).copy_from_slice(&bytes[..T::BYTES]);
    }
    sign(image);
}

/// Uses arbitrary bytes as the words of an image with valid checksums and sums. Such an image can be refused only for a
/// value out of range.
pub fn of_any_bytes<T: Word>(bytes: &[u8]) -> Vec<u8> {
    let mut image = T::empty();
    let end = image.len() - 4;
    for (target, byte) in image[HEADER..end].iter_mut().zip(bytes) {
        *target = *byte;
    }
    sum_and_sign::<T>(&mut image);
    image
}

/// Like [`revise_and_sign`], after correcting the two dependent scalars.
pub fn sum_and_sign<T: Word>(image: &mut [u8]) {
    let half_clearance = word::<T>(image, HALF_CLEARANCE).to_vec();
    let offset = T::sum(&half_clearance, word::<T>(image, HELD));
    word::<T>(image, OFFSET).copy_from_slice(&offset);
    let first_knot = word::<T>(image, FIRST_KNOT).to_vec();
    let bound = T::stretch_bound(&offset, &first_knot, word::<T>(image, MOVE_BOUND));
    word::<T>(image, STRETCH_BOUND).copy_from_slice(&bound);
    revise_and_sign::<T>(image);
}
