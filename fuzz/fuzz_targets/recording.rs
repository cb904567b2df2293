//! Reads any bytes as a recording. Either they are refused, or the rows are finite and their times increase.
#![no_main]

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_recording::{Channels, Recording, overview};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Reads all contents of the file, whatever the names of its channels.
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("a temporary file");
    let _ = overview(file.path(), &Channels::default());
    // Also adds a header, which random bytes hardly ever contain.
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
