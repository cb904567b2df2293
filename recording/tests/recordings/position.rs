//! Number of bytes read so far, which a progress bar shows.

use std::io::{Cursor, Write};
use std::path::Path;
use std::rc::Rc;

use dashpot_recording::{Channels, Measurement, Recording, Sample};
use flate2::Compression;
use flate2::write::GzEncoder;

const NAME: &str = "run7";

/// Returns a text of 4000 rows, longer than the buffers of its readers.
fn text() -> Vec<u8> {
    let rows: String = (0..4000)
        .map(|row| format!("{row},{},{}\n", row * 7919 % 1000, row * 7907 % 1000))
        .collect();
    format!("time_s,displacement_m,force_n\n{rows}").into_bytes()
}

fn source(bytes: &[u8]) -> Box<Cursor<Vec<u8>>> {
    Box::new(Cursor::new(bytes.to_vec()))
}

/// Text is read in blocks, so that the position may be ahead of the row.
#[test]
fn text_is_counted_by_the_bytes_read() {
    let text = text();
    let mut recording = Recording::read(Path::new(NAME), source(&text)).expect("a text");
    let start = recording.position();
    assert!(start > 0 && start < text.len() as u64, "{start}");
    recording.read_all().expect("valid rows");
    assert_eq!(recording.position(), text.len() as u64);
    let channels = Channels::default();
    let measurement = Measurement::read(Path::new(NAME), source(&text), &channels);
    let mut measurement = measurement.expect("a text");
    assert_eq!(measurement.position(), start);
    measurement.read_all().expect("valid rows");
    assert_eq!(measurement.position(), text.len() as u64);
}

#[test]
fn compressed_text_is_counted_by_the_bytes_of_the_file() {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
    gzip.write_all(&text()).expect("memory");
    let bytes = gzip.finish().expect("memory");
    let mut recording = Recording::read(Path::new(NAME), source(&bytes)).expect("a text");
    recording.read_all().expect("valid rows");
    assert_eq!(recording.position(), bytes.len() as u64);
}

#[test]
fn samples_in_memory_are_counted_by_rows() {
    let sample = |row: u32| Sample {
        time_s: f64::from(row),
        displacement_m: 0.0,
    };
    let samples = Rc::new((0..5).map(sample).collect());
    let mut recording = Recording::from_samples(Path::new(NAME), samples);
    let mut positions = vec![recording.position()];
    while recording.next_sample().expect("valid rows").is_some() {
        positions.push(recording.position());
    }
    assert_eq!(positions, [0, 1, 2, 3, 4, 5]);
}

/// MDF4 and Parquet are read in blocks in an order that only their libraries know, so that the position follows from
/// the share of the rows.
#[cfg(all(feature = "mdf", feature = "parquet"))]
#[test]
fn binary_files_are_counted_by_the_share_of_their_rows() {
    use dashpot_recording::writer::{Column, FileFormat, RowWriter};

    let columns = [
        Column::new("time_s", "s"),
        Column::new("displacement_m", "m"),
    ];
    for format in [FileFormat::Mdf4, FileFormat::Parquet] {
        let mut bytes = Vec::new();
        let mut writer =
            RowWriter::new(Path::new(NAME), &mut bytes, format, &columns).expect("memory");
        for row in 0..8 {
            let values = [f64::from(row), 0.5];
            writer.row(&values, values).expect("memory");
        }
        writer.finish().expect("memory");
        let mut recording = Recording::read(Path::new(NAME), source(&bytes)).expect("a file");
        for row in 0..=8 {
            assert_eq!(recording.position(), bytes.len() as u64 * row / 8);
            let sample = recording.next_sample().expect("valid rows");
            assert_eq!(sample.is_some(), row < 8);
        }
        // Only the lines of text may be cut off.
        assert_eq!(recording.gaps().unended_line, None);
    }
}
