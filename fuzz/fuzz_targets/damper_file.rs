//! Reads any text as a damper file. Either it is refused, or the damper builds, or the error of the build names a
//! field.
#![no_main]

use dashpot_files::damper;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(parameters) = damper::parse("fuzz.toml", text, &[]) {
        let _ = parameters.build::<f32>(1e-3);
    }
});
