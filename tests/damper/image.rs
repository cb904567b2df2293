//! A damper saved as bytes is restored completely or refused completely.

use dashpot::damper;
use dashpot::signed_image::{self, SCALARS, TABLE, crc_32, revise_and_sign, sign};
use dashpot_core::{Damper, ImageError};
use proptest::prelude::*;

fn single() -> Damper<f32> {
    damper("in-service", &[]).build(1e-3).expect("a preset")
}

fn image() -> Vec<u8> {
    single().to_image().to_vec()
}

fn read(image: &[u8]) -> Result<Damper<f32>, ImageError> {
    Damper::<f32>::from_image(image)
}

#[test]
fn every_preset_comes_back() {
    for preset in [
        "paper",
        "calibrated",
        "in-service",
        "reduced-vertical",
        "reduced-lateral",
    ] {
        let single: Damper<f32> = damper(preset, &[]).build(1e-3).expect("a preset");
        assert_eq!(read(&single.to_image()), Ok(single));
        let double: Damper<f64> = damper(preset, &[]).build(1e-4).expect("a preset");
        assert_eq!(Damper::<f64>::from_image(&double.to_image()), Ok(double));
    }
}

/// One comparison finds the piece of a reach only if no bin has two knots. The exponent and seven bits
/// of the fraction name a bin.
#[test]
fn no_bin_has_two_knots() {
    const WORDS_OF_PIECE: usize = 13;
    for (name, preset, overrides) in dashpot::accuracy::DAMPERS {
        for step_s in dashpot::accuracy::STEPS_S {
            let built: Damper<f64> = damper(preset, overrides).build(step_s).expect("a preset");
            let words = built.to_words();
            let pieces: Vec<&[u64]> = words[TABLE..].chunks_exact(WORDS_OF_PIECE).collect();
            for side in pieces.chunks(pieces.len() / 2) {
                let knots = side.iter().map(|piece| piece[WORDS_OF_PIECE - 1]);
                let bins: Vec<u64> = knots
                    .filter(|knot| *knot != f64::MAX.to_bits())
                    .map(|knot| knot >> (52 - 7))
                    .collect();
                assert!(bins.len() > 1, "{name}, {step_s} s");
                assert!(
                    bins.is_sorted_by(|a, b| a < b),
                    "{name}, {step_s} s: {bins:?}"
                );
            }
        }
    }
}

#[test]
fn a_damper_changed_live_comes_back() {
    let mut damper = single();
    damper.set_clearance_m(2.5e-3).unwrap();
    assert_eq!(read(&damper.to_image()), Ok(damper));
}

#[test]
fn the_layout_is_as_documented() {
    assert_eq!(crc_32(b"123456789"), 0xcbf4_3926); // the published check value
    let (image, words) = (image(), single().to_words());
    assert_eq!(image.len(), Damper::<f32>::IMAGE_BYTES);
    assert_eq!(&image[..8], b"DASH\xff\xfe\x04\x00");
    assert_eq!(image[8..12], 4_u32.to_le_bytes());
    assert_eq!(image[12..16], (image.len() as u32).to_le_bytes());
    let end = image.len() - 4;
    let body: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    assert_eq!(image[16..end], body);
    let mut signed = image.clone();
    sign(&mut signed);
    assert_eq!(signed, image);
}

#[test]
fn every_flipped_bit_is_refused_and_changes_nothing() {
    let mut image = image();
    let kept: Damper<f32> = damper("paper", &[]).build(1e-3).expect("a preset");
    let mut loaded = kept;
    for bit in 0..8 * image.len() {
        image[bit / 8] ^= 1 << (bit % 8);
        let refused = loaded.load_image(&image);
        let as_expected = match bit / 8 {
            0..4 => refused == Err(ImageError::Magic),
            4..6 => refused == Err(ImageError::ByteOrder),
            6..8 => matches!(refused, Err(ImageError::Version(_))),
            8..12 => matches!(refused, Err(ImageError::Scalar(_))),
            12..16 => matches!(refused, Err(ImageError::Length { .. })),
            _ => refused == Err(ImageError::Checksum),
        };
        assert!(as_expected, "bit {bit}: {refused:?}");
        assert_eq!(Damper::<f32>::check_image(&image).map(drop), refused);
        image[bit / 8] ^= 1 << (bit % 8);
    }
    assert_eq!(loaded, kept);
    assert_eq!(Damper::<f32>::check_image(&image).map(drop), Ok(()));
    assert_eq!(loaded.load_image(&image), Ok(()));
    assert_eq!(loaded, single());
}

#[test]
fn every_truncation_and_extra_bytes_are_refused() {
    let mut image = image();
    let expected = image.len() as u32;
    for found in 0..expected {
        let refused = read(&image[..found as usize]);
        assert_eq!(refused, Err(ImageError::Length { expected, found }));
    }
    image.push(0);
    let found = expected + 1;
    let refused = read(&image);
    assert_eq!(refused, Err(ImageError::Length { expected, found }));
}

#[test]
fn the_other_scalar_is_refused() {
    let double: Damper<f64> = damper("paper", &[]).build(1e-3).expect("a preset");
    assert_eq!(read(&double.to_image()), Err(ImageError::Scalar(8)));
    let refused = Damper::<f64>::from_image(&image());
    assert_eq!(refused, Err(ImageError::Scalar(4)));
}

/// Invalid constants are refused despite a valid CRC-32: each word in turn is set to a non-finite number and to another
/// number.
#[test]
fn constants_of_no_build_are_refused_though_signed() {
    let image = image();
    for at in (16..image.len() - 4).step_by(4) {
        let word = u32::from_le_bytes(image[at..at + 4].try_into().expect("four bytes"));
        let infinite = f32::INFINITY.to_bits();
        for other in [f32::NAN.to_bits(), infinite, word ^ 1, word ^ 0x8000_0000] {
            let mut changed = image.clone();
            changed[at..at + 4].copy_from_slice(&other.to_le_bytes());
            sign(&mut changed);
            // The image has a header of 16 bytes, thirteen words, then table pieces of thirteen words each.
            let piece = (at / 4).checked_sub(17).map(|word| word as u32 / 13);
            let finite = f32::from_bits(other).is_finite();
            let expected = match piece {
                Some(piece) if !finite => ImageError::Piece(piece),
                _ => ImageError::Revision,
            };
            assert_eq!(read(&changed), Err(expected), "{other:#x} at byte {at}");
        }
    }
}

/// The preset's image with some words replaced by these numbers, and with valid revisions and CRC-32.
fn forged(changes: &[(usize, f32)]) -> Vec<u8> {
    let mut image = image();
    for (index, value) in changes {
        signed_image::word::<f32>(&mut image, *index).copy_from_slice(&value.to_le_bytes());
    }
    revise_and_sign::<f32>(&mut image);
    image
}

#[test]
fn constants_out_of_range_are_refused_though_their_revision_is_right() {
    let damper = single();
    let words = damper.to_words();
    assert_eq!(words[SCALARS], damper.revision());
    assert_eq!(read(&forged(&[])), Ok(damper));
    // The changed words are, in the order of the scalars: step, offset, first knot, half the clearance, and the bounds
    // of displacement and stretch.
    let bound = |metres: f32| f32::from_bits(metres.to_bits() << 1);
    let mut cases = vec![(3, 0.0_f32), (4, 1e-3), (5, 0.0), (6, 1e-3)];
    cases.extend([(9, bound(0.71)), (9, bound(9e-4)), (10, bound(0.2))]);
    for scalar in 0..SCALARS {
        cases.extend([f32::NAN, f32::INFINITY, -1.0].map(|value| (scalar, value)));
    }
    // A clearance beyond the maximum, with the dependent sum adjusted.
    let loose = [(6, 0.051), (4, 0.051 + f32::from_bits(words[8]))];
    assert_eq!(read(&forged(&loose)), Err(ImageError::Scalars));
    let last = words.len() - 1;
    for coefficient in [TABLE, last] {
        cases.extend([(coefficient, f32::NAN), (coefficient, f32::NEG_INFINITY)]);
    }
    for change in cases {
        let refused = read(&forged(&[change]));
        let expected = match change.0.checked_sub(TABLE) {
            Some(word) => ImageError::Piece(word as u32 / 13),
            None => ImageError::Scalars,
        };
        assert_eq!(refused, Err(expected), "{change:?}");
    }
}

#[test]
fn errors_say_what_is_wrong() {
    let expected = Damper::<f32>::IMAGE_BYTES;
    for (bytes, part) in [
        (&b""[..], format!("0 bytes, but a damper has {expected}")),
        (&[0; 40][..], "DASH".into()),
        (&image()[1..], "DASH".into()),
    ] {
        let message = read(bytes).expect_err("no damper").to_string();
        assert!(message.contains(&part), "{message}");
    }
}

proptest! {
    #[test]
    fn arbitrary_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..8000)) {
        prop_assert!(read(&bytes).is_err());
        prop_assert!(Damper::<f64>::from_image(&bytes).is_err());
    }

    #[test]
    fn arbitrary_damage_is_refused(
        from in 0_usize..6000, damage in prop::collection::vec(any::<u8>(), 1..100), sign: bool,
    ) {
        let mut damaged = image();
        let from = from % damaged.len();
        for (byte, damage) in damaged[from..].iter_mut().zip(&damage) {
            *byte ^= damage;
        }
        if sign {
            signed_image::sign(&mut damaged);
        }
        match read(&damaged) {
            // Signing again repairs damage to the CRC-32 alone, and the random damage may change nothing.
            Ok(read) => prop_assert!(damaged == image() && read == single()),
            Err(_) => prop_assert_ne!(damaged, image()),
        }
    }
}
