//! Any bytes as a damper's image or a saved state: refused, or a damper whose force keeps its limit.
//!
//! Bytes at random never have the right CRC-32, so it is made right.
#![no_main]

use dashpot_core::{Damper, crc_32};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut image = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]).to_image();
    for (place, byte) in image.iter_mut().skip(16).zip(bytes) {
        *place = *byte;
    }
    let end = image.len() - 4;
    let check = crc_32(&image[..end]).to_le_bytes();
    image[end..].copy_from_slice(&check);
    for image in [bytes, &image[..]] {
        let Ok(damper) = Damper::<f32>::from_image(image) else {
            continue;
        };
        let mut state = damper.at_rest(0.0);
        if let Some(saved) = bytes.first_chunk()
            && let Ok(restored) = damper.state_from_bytes(saved)
        {
            state = restored;
        }
        for x in [1e-3, -1e-3, f32::NAN, 1.0] {
            assert!(damper.step(&mut state, x).abs() <= damper.force_limit_n());
        }
    }
});
