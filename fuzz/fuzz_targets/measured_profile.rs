//! Any text as a measured wheel or rail profile: refused, or a profile.
#![no_main]

use dashpot_rail::profile::{Body, measured};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for body in [Body::Wheel, Body::Rail] {
        let _ = measured::parse("fuzz", text, body, measured::DEFAULT_SMOOTHING_M);
    }
});
