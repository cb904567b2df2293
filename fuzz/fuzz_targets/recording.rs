//! Reads any bytes as a recording. Either they are refused, or the rows are finite and their times increase. Plain rows
//! give the same samples with and without the CSV reader; of several reasons to refuse a file, the first one that has
//! arrived is reported.
#![no_main]

use std::io::{self, Cursor, Read, Write};
use std::path::Path;

use dashpot_recording::{Channels, Recording, Sample, overview};
use libfuzzer_sys::fuzz_target;

/// Source that returns one byte at a time. It never has a whole line, so that the CSV reader reads all rows.
struct Bytes(Cursor<Vec<u8>>);

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = buffer.len().min(1);
        self.0.read(&mut buffer[..length])
    }
}

/// Reads all samples, or returns the error.
fn read(source: Box<dyn Read>) -> Result<Vec<Sample>, String> {
    let recording = Recording::read(Path::new("fuzz.csv"), source);
    let samples = recording.and_then(|mut recording| recording.read_all());
    samples.map_err(|error| error.to_string())
}

fuzz_target!(|bytes: &[u8]| {
    // Reads all contents of the file, whatever the names of its channels.
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("a temporary file");
    let _ = overview(file.path(), &Channels::default());
    // Also adds a header, which random bytes hardly ever contain.
    let headed = [b"time_s,displacement_m\n", bytes].concat();
    for text in [bytes.to_vec(), headed] {
        let found = read(Box::new(Cursor::new(text.clone())));
        let by_bytes = read(Box::new(Bytes(Cursor::new(text))));
        assert_eq!(found.as_ref().ok(), by_bytes.as_ref().ok());
        let Ok(samples) = found else {
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
