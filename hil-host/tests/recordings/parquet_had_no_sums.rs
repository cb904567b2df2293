//! Regression: a changed byte in a Parquet file written by Dashpot silently changed values, because the file had no
//! checksums.

use std::fs::File;
use std::io::Cursor;
use std::path::Path;

use dashpot_recording::columns;
use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_recording::{Channels, MeasuredSample, Measurement};
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::common::{dashpot, error_of, files_in};

const COLUMNS: [Column; 3] = [
    Column::new("time_s", "s"),
    Column::new("displacement_m", "m"),
    Column::new("force_n", "N"),
];

fn read(bytes: &[u8]) -> Result<Vec<MeasuredSample>, String> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Measurement::read(Path::new("own.parquet"), source, &Channels::default())
        .and_then(|mut measurement| measurement.read_all())
        .map_err(|error| error.to_string())
}

/// Writes one of our own files into `folder`.
fn own(folder: &Path, rows: usize) -> Vec<u8> {
    let path = folder.join("own.parquet");
    let mut file = File::create(&path).unwrap();
    let mut written = RowWriter::new(&path, &mut file, FileFormat::Parquet, &COLUMNS).unwrap();
    for row in 0..rows {
        let time_s = row as f64 / 1e3;
        let values = [time_s, 1e-2 * (8.8 * time_s).sin(), 8e3 * time_s.cos()];
        written.row(&values, values).unwrap();
    }
    written.finish().unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn no_changed_byte_of_our_own_files_changes_values() {
    let folder = tempfile::tempdir().unwrap();
    let mut bytes = own(folder.path(), 100);
    let whole = read(&bytes).unwrap();
    assert_eq!(whole.len(), 100);
    let (mut by_sum, mut unchanged) = (0, 0);
    for at in 0..bytes.len() {
        for bit in [1 << (at % 8), 0xff] {
            bytes[at] ^= bit;
            match read(&bytes) {
                Ok(found) => {
                    assert_eq!(found, whole, "byte {at}, {bit:#x}");
                    unchanged += 1;
                }
                Err(error) => by_sum += usize::from(error.contains("SHA-256")),
            }
            bytes[at] ^= bit;
        }
    }
    // Most bytes are values that Snappy did not compress; bytes without effect belong to statistics and program names.
    assert!(by_sum > bytes.len() / 2, "{by_sum} of {}", 2 * bytes.len());
    assert!(unchanged < bytes.len(), "{unchanged}");
}

/// The file has more rows than fit into a row group.
#[test]
fn long_files_have_checksums_of_all_rows() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = own(folder.path(), 70_000);
    assert_eq!(read(&bytes).unwrap().len(), 70_000);
}

#[test]
fn the_commands_refuse_a_changed_column_and_name_it() {
    let folder = tempfile::tempdir().unwrap();
    let whole = own(folder.path(), 100);
    for column in ["displacement_m", "force_n"] {
        let expected = format!("own.parquet: column {column}: the SHA-256 of its numbers");
        let changed = (0..whole.len()).find_map(|at| {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            let error = read(&bytes).err()?;
            error.starts_with(&expected).then_some(bytes)
        });
        std::fs::write(folder.path().join("own.parquet"), changed.unwrap()).unwrap();
        let ended = dashpot(&["channels", "own.parquet"], folder.path());
        let error = error_of(&ended);
        assert!(
            error.contains(&expected) && error.contains("dashpot_sha256"),
            "{error}"
        );
        ended.code(1);
        let replay = ["replay", "--input", "own.parquet", "--output", "force.csv"];
        let ended = dashpot(&replay, folder.path());
        match column {
            "displacement_m" => {
                assert!(error_of(&ended).contains(&expected));
                ended.code(1);
                assert_eq!(files_in(folder.path()), ["own.parquet"]);
            }
            // The force is not read.
            _ => drop(ended.success()),
        }
    }
}

/// The tables are those of a vehicle's history, with text and empty cells.
#[test]
fn tables_have_checksums_of_their_values() {
    let folder = tempfile::tempdir().unwrap();
    let [csv, path] = ["table.csv", "table.parquet"].map(|name| folder.path().join(name));
    let rows: String = (0..100).map(|i| format!("{i},0.5,{},a\n", 2 * i)).collect();
    let text = format!("time_s,displacement_m,force_n,note\n{rows}100,,200,b\n");
    std::fs::write(&csv, text).unwrap();
    columns::write(&csv, &path, &[]).unwrap();
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata().key_value_metadata();
    let metadata = metadata
        .unwrap()
        .iter()
        .find(|pair| pair.key == "dashpot_sha256");
    let sums: serde_json::Value =
        serde_json::from_str(metadata.unwrap().value.as_ref().unwrap()).unwrap();
    let names: Vec<_> = sums.as_object().unwrap().keys().collect();
    assert_eq!(names, ["displacement_m", "force_n", "time_s"]);
    let mut bytes = std::fs::read(&path).unwrap();
    let skipping = Channels {
        skip_invalid: true,
        ..Channels::default()
    };
    let read = |bytes: &[u8]| {
        let source = Box::new(Cursor::new(bytes.to_vec()));
        Measurement::read(Path::new("table.parquet"), source, &skipping)
            .and_then(|mut measurement| measurement.read_all())
    };
    let whole = read(&bytes).unwrap();
    assert_eq!(whole.len(), 100);
    for at in 0..bytes.len() {
        bytes[at] ^= 0x10;
        if let Ok(found) = read(&bytes) {
            assert_eq!(found, whole, "byte {at}");
        }
        bytes[at] ^= 0x10;
    }
}
