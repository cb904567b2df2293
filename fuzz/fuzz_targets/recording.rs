//! Any bytes as a recording: refused, or rows of finite numbers whose time grows.
#![no_main]

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_recording::{Channels, Recording, overview};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // All that a file has is looked at, whatever its channels are called.
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("a temporary file");
    let _ = overview(file.path(), &Channels::default());
    // With and without a header, which bytes at random hardly ever are.
    let headed = [b"time_s,displacement_m\n", bytes].concat();
    for text in [bytes.to_vec(), headed] {
        let recording = Recording::read(Path::new("fuzz.csv"), Box::new(Cursor::new(text)));
        let Ok(samples) = recording.and_then(|mut recording| recording.read_all()) else {
            continue;
        };
        assert!(!samples.is_empty());
        assert!(
            samples
                .iter()
                .all(|s| s.time_s.is_finite() && s.displacement_m.is_finite())
        );
        assert!(
            samples
                .windows(2)
                .all(|pair| pair[0].time_s < pair[1].time_s)
        );
    }
});
