//! Files that are truncated or have a flipped bit: they are rejected, or only existing rows are read; no panic, no
//! endless loop.

use std::io::Cursor;
use std::path::Path;

use dashpot_recording::{MeasuredSample, Measurement};

use crate::forms::{FORMS, Form, samples};

fn read(bytes: &[u8], form: &Form) -> Result<Vec<MeasuredSample>, String> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Measurement::read(Path::new(form.file), source, &form.channels())
        .and_then(|mut measurement| measurement.read_all())
        .map_err(|error| error.to_string())
}

fn is_binary(form: &&Form) -> bool {
    !form.file.ends_with(".csv")
}

#[test]
fn truncated_files_are_refused() {
    for form in FORMS.iter().filter(is_binary) {
        let whole = std::fs::read(samples().join(form.file)).unwrap();
        let rows = read(&whole, form).unwrap();
        for length in (0..whole.len()).step_by(61) {
            match read(&whole[..length], form) {
                Err(error) => assert!(error.starts_with(form.file), "{error}"),
                // The missing part may belong to other groups or not be needed.
                Ok(read) => assert_eq!(read, rows, "{} of {length} bytes", form.file),
            }
        }
    }
}

/// MDF4 and Parquet have checksums only where their contents are compressed or the writer adds them. A flipped bit may
/// change a value, but it may not add rows or produce values that are not numbers.
#[test]
fn files_with_a_flipped_bit_are_refused_or_read() {
    for form in FORMS.iter().filter(is_binary) {
        let mut bytes = std::fs::read(samples().join(form.file)).unwrap();
        let rows = read(&bytes, form).unwrap();
        let has_sum = form.file.ends_with(".gz");
        for at in 0..bytes.len() {
            let bit = 1 << (at % 8);
            bytes[at] ^= bit;
            if let Ok(found) = read(&bytes, form) {
                assert!(found.len() <= rows.len(), "{} at {at}", form.file);
                assert!(!has_sum || found == rows, "{} at {at}", form.file);
                let all = found
                    .iter()
                    .flat_map(|s| [s.time_s, s.displacement_m, s.force_n]);
                assert!(all.into_iter().all(f64::is_finite));
            }
            bytes[at] ^= bit;
        }
    }
}
