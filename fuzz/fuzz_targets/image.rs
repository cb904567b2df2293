//! Reads any bytes as the image of a damper or as a saved state. Either they are refused, or the force of the damper is
//! within its limit.
//!
//! Random bytes never have a correct CRC-32 and correct revisions, so the target corrects them. Most images with finite
//! numbers are then valid dampers.
#![no_main]

use dashpot::signed_image::of_any_bytes;
use dashpot_core::Damper;
use libfuzzer_sys::fuzz_target;

/// Number of bytes before the words of an image.
const HEADER: usize = 16;

macro_rules! refused_or_stepped {
    ($float:ident, $bytes:expr) => {{
        let bytes: &[u8] = $bytes;
        let words = bytes.get(HEADER..).unwrap_or_default();
        for image in [bytes, &of_any_bytes::<$float>(words)] {
            let Ok(damper) = Damper::<$float>::from_image(image) else {
                continue;
            };
            // The last bytes become the state if this damper accepts them as one.
            let saved = bytes
                .last_chunk()
                .and_then(|saved| damper.state_from_bytes(saved).ok());
            let mut state = saved.unwrap_or_else(|| damper.at_rest(0.0));
            for x in [1e-3, -1e-3, $float::NAN, 1.0] {
                assert!(damper.step(&mut state, x).abs() <= damper.force_limit_n());
            }
        }
    }};
}

fuzz_target!(|bytes: &[u8]| {
    refused_or_stepped!(f32, bytes);
    refused_or_stepped!(f64, bytes);
});
