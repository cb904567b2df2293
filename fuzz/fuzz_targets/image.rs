//! Any bytes as a damper's image or a saved state: refused, or a damper whose force keeps its limit.
//!
//! Bytes at random never have the right CRC-32 and revisions, so they are made right: then most images whose
//! numbers are finite are dampers.
#![no_main]

use dashpot::signed_image::of_any_bytes;
use dashpot_core::Damper;
use libfuzzer_sys::fuzz_target;

/// Bytes before the words of an image.
const HEADER: usize = 16;

macro_rules! refused_or_stepped {
    ($float:ident, $bytes:expr) => {{
        let bytes: &[u8] = $bytes;
        let words = bytes.get(HEADER..).unwrap_or_default();
        for image in [bytes, &of_any_bytes::<$float>(words)] {
            let Ok(damper) = Damper::<$float>::from_image(image) else {
                continue;
            };
            // The last bytes are a state, if it is one of this damper.
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
