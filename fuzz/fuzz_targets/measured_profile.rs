//! Any bytes as a measured wheel or rail profile: refused, or a profile.
#![no_main]

use std::io::Write;

use dashpot_hil::contact::{measured, profile::Body};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("room for the file");
    for body in [Body::Wheel, Body::Rail] {
        let _ = measured::read(file.path(), body, measured::DEFAULT_SMOOTHING);
    }
});
