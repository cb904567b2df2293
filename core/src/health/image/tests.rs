//! Images of health models: their bytes, and every reason to refuse them.

use super::super::model::{Baseline, HealthModel, MARK, MIN_TICKS};
use super::{BYTES_PER_SLICE, HealthImageError, HealthLoading, WORDS, WORDS_PER_SLICE, crc_32};

/// The smallest valid constants.
fn model() -> HealthModel {
    HealthModel {
        mark: MARK,
        half_step_s: 0.5e-3,
        block_ticks: MIN_TICKS,
        baseline: Baseline::new(1.5, 2.5, 3.5),
        ..HealthModel::EMPTY
    }
}

/// An image with changed bytes and the CRC-32 that matches them.
fn changed(change: impl FnOnce(&mut [u8])) -> Result<HealthModel, HealthImageError> {
    let mut image = model().to_image();
    let end = image.len() - 4;
    change(&mut image[..end]);
    let check = crc_32(&image[..end]);
    image[end..].copy_from_slice(&check.to_le_bytes());
    HealthModel::from_image(&image)
}

#[test]
fn an_image_is_a_header_the_words_and_their_checksum() {
    let image = model().to_image();
    assert_eq!(image.len(), 8 + size_of::<HealthModel>() + 4);
    assert_eq!(image.len(), HealthModel::IMAGE_BYTES);
    assert_eq!(image[..4], *b"DAHM");
    assert_eq!(image[4..8], [2, 0, 0, 0]);
    // The first two constants are the mark, "DAHM" too, and half the step.
    assert_eq!(image[8..12], *b"DAHM");
    assert_eq!(image[12..16], 0.5e-3_f32.to_le_bytes());
    let (checked, check) = image.split_at(image.len() - 4);
    assert_eq!(check, crc_32(checked).to_le_bytes());
    assert_eq!(HealthModel::from_image(&image), Ok(model()));
}

#[test]
fn an_image_of_another_length_is_refused() {
    let image = model().to_image();
    let mut longer = [0; HealthModel::IMAGE_BYTES + 1];
    longer[..image.len()].copy_from_slice(&image);
    for bytes in [&image[..image.len() - 1], &longer[..], &[]] {
        let expected = HealthImageError::Length {
            expected: image.len() as u32,
            found: bytes.len() as u32,
        };
        assert_eq!(HealthModel::from_image(bytes), Err(expected));
    }
}

#[test]
fn each_byte_of_the_magic_word_counts_before_the_version_and_that_before_the_checksum() {
    for byte in 0..4 {
        let mut image = model().to_image();
        image[byte] ^= 1;
        image[4] = 9;
        let refused = HealthModel::from_image(&image);
        assert_eq!(refused, Err(HealthImageError::Magic));
    }
    let mut image = model().to_image();
    image[5] = 1;
    let refused = HealthModel::from_image(&image);
    assert_eq!(refused, Err(HealthImageError::Version(258)));
}

#[test]
fn a_damaged_byte_anywhere_after_the_header_is_found() {
    let image = model().to_image();
    for byte in (8..image.len()).step_by(101).chain([image.len() - 1]) {
        let mut damaged = image;
        damaged[byte] ^= 0x10;
        let refused = HealthModel::from_image(&damaged);
        assert_eq!(refused, Err(HealthImageError::Checksum), "byte {byte}");
    }
}

#[test]
fn constants_that_no_build_produces_are_refused() {
    let with = |change: fn(&mut HealthModel)| {
        let mut model = model();
        change(&mut model);
        HealthModel::from_image(&model.to_image()).map(|found| assert_eq!(found, model))
    };
    assert_eq!(with(|model| model.block_ticks = 9), Ok(()));
    for change in [
        (|model| model.mark ^= 1) as fn(&mut HealthModel),
        |model| model.block_ticks = 7,
        |model| model.half_step_s = 0.0,
        |model| model.half_step_s = -0.5e-3,
        |model| model.half_step_s = f32::INFINITY,
        |model| model.half_step_s = f32::NAN,
    ] {
        assert_eq!(with(change), Err(HealthImageError::Values));
    }
    assert_eq!(changed(|_| {}), Ok(model()));
    assert_eq!(
        changed(|bytes| bytes[8] ^= 1),
        Err(HealthImageError::Values)
    );
}

#[test]
fn loading_takes_one_slice_at_a_time() {
    let image = model().to_image();
    let mut loading = HealthLoading::START;
    for _ in 0..(image.len() - 4) / BYTES_PER_SLICE {
        assert!(matches!(loading.check_slice(&image), Ok(None)));
    }
    let checked = loading.check_slice(&image).expect("the image is intact");
    let checked = checked.expect("all slices are checked");
    let mut found = HealthModel::EMPTY;
    #[cfg(feature = "link")]
    {
        assert_eq!(checked.step_s(), 1e-3);
        assert!(loading.writes_nothing_yet());
    }
    let slices = WORDS.div_ceil(WORDS_PER_SLICE);
    for slice in 1..=slices {
        assert_eq!(loading.write_slice(&checked, &mut found), slice == slices);
        #[cfg(feature = "link")]
        assert!(!loading.writes_nothing_yet());
        assert_eq!(found.mark, MARK);
    }
    assert_eq!(found, model());
}
