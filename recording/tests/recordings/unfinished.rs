//! MDF4 files that their logger did not finish.

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{Channels, ForceHistory, Gaps, Measurement, UnfinishedEnd, overview};
use falcon_mdf::Mf4Writer;

const ROWS: usize = 5;

/// Bytes of a row: the time, the displacement and the force.
const ROW: usize = 3 * 8;

/// Bytes of the header of a block.
const HEADER: usize = 24;

/// Flags for numbers of rows and the length of the last data block (`id_unfin_flags`).
const COUNTS: u8 = 1;
const LAST_LENGTH: u8 = 4;

fn find(bytes: &[u8], mark: &[u8; 4]) -> usize {
    bytes
        .windows(4)
        .position(|found| found == mark)
        .expect("a block")
}

/// Returns a file as a logger leaves it: its data block is the last one and has no length yet, and there is no number
/// of rows.
fn logged(flags: u8) -> Vec<u8> {
    let numbers = |scale: f64| [0, 1, 2, 3, 4].map(|row| scale * f64::from(row));
    let mut writer = Mf4Writer::with_start_time_ns(0);
    let group = writer.add_group(&numbers(0.5)).expect("increasing times");
    for (name, unit, scale) in [("displacement_m", "m", 1.0), ("force_n", "N", -10.0)] {
        group
            .add_channel(name, unit, &numbers(scale))
            .expect("numbers");
    }
    let mut bytes = Vec::new();
    writer.write(&mut bytes).expect("memory");
    let data = find(&bytes, b"##DT");
    let mut block = bytes[data..data + HEADER + ROWS * ROW].to_vec();
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    let link = find(&bytes, b"##DG") + HEADER + 2 * 8;
    let end = bytes.len() as u64;
    bytes[link..link + 8].copy_from_slice(&end.to_le_bytes());
    if flags & COUNTS != 0 {
        let count = find(&bytes, b"##CG") + HEADER + 6 * 8 + 8;
        bytes[count..count + 8].fill(0);
    }
    if flags & LAST_LENGTH != 0 {
        block[8..16].copy_from_slice(&24_u64.to_le_bytes());
    }
    bytes.extend(block);
    bytes[..8].copy_from_slice(b"UnFinMF ");
    bytes[60] = flags;
    bytes
}

fn read(bytes: &[u8]) -> Result<(Vec<f64>, Gaps), FileError> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    let mut measurement = Measurement::read(Path::new("run7.mf4"), source, &Channels::default())?;
    let rows = measurement.read_all()?;
    Ok((
        rows.iter().map(|row| row.force_n).collect(),
        measurement.gaps(),
    ))
}

fn error_of(bytes: &[u8]) -> String {
    read(bytes).expect_err("an uncertain file").to_string()
}

/// Wherever the logger was when it crashed, the whole rows are read.
#[test]
fn rows_are_read_up_to_the_last_whole_one() {
    for flags in [COUNTS | LAST_LENGTH, COUNTS, 0x7f, 0] {
        let bytes = logged(flags | if flags == 0 { COUNTS | LAST_LENGTH } else { 0 });
        let bytes = if flags == 0 {
            [&bytes[..60], &[0], &bytes[61..]].concat()
        } else {
            bytes
        };
        for cut in 0..(ROWS - 1) * ROW {
            let (forces, gaps) = read(&bytes[..bytes.len() - cut])
                .unwrap_or_else(|error| panic!("{flags}, {cut}: {error}"));
            let left = (ROWS * ROW - cut) % ROW;
            let whole = (ROWS * ROW - cut) / ROW;
            let expected: Vec<f64> = [0.0, -10.0, -20.0, -30.0, -40.0][..whole].to_vec();
            assert_eq!(forces, expected, "{flags}, {cut}");
            let end = UnfinishedEnd {
                left_bytes: left as u64,
            };
            assert_eq!(gaps.unfinished, Some(end), "{flags}, {cut}");
        }
    }
}

#[test]
fn every_reader_reports_an_unfinished_file() {
    let bytes = logged(COUNTS | LAST_LENGTH);
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(&bytes[..bytes.len() - 1])
        .expect("a writable file");
    let end = Some(UnfinishedEnd { left_bytes: 23 });
    let overview = overview(file.path(), &Channels::default()).expect("a file");
    assert_eq!(overview.unfinished, end);
    assert_eq!(overview.channels[1].rows, 4);
    let history = ForceHistory::open(file.path(), 0.0..=1.5).expect("a file");
    assert_eq!(history.unfinished(), end);
    // The file of the user is as it was.
    assert_eq!(
        std::fs::read(file.path()).expect("a file"),
        &bytes[..bytes.len() - 1]
    );
}

#[test]
fn uncertain_files_are_refused() {
    let mut own = logged(COUNTS | LAST_LENGTH);
    own[62] = 2;
    let expected = "run7.mf4: the MDF4 file is unfinished and cannot be read up to its last whole row: its logger has \
                    left steps open that only its own software knows (flags 0x0002)";
    assert_eq!(error_of(&own), expected);
    let mut unknown = logged(COUNTS | LAST_LENGTH);
    unknown[61] = 1;
    assert!(error_of(&unknown).contains("flags that the standard does not define (0x0100)"));
    // The number of rows is final, but some are missing.
    let counted = logged(LAST_LENGTH);
    assert_eq!(read(&counted).expect("all rows").0.len(), ROWS);
    let error = error_of(&counted[..counted.len() - ROW]);
    assert!(
        error.contains("the file declares 5 rows but has 4"),
        "{error}"
    );
    // A finished file that was cut is not one that a logger did not finish.
    let mut finished = logged(0);
    finished[..8].copy_from_slice(b"MDF     ");
    assert_eq!(read(&finished).expect("all rows").1.unfinished, None);
    assert!(read(&finished[..finished.len() - ROW]).is_err());
    // No row has reached the disk.
    let head = logged(COUNTS | LAST_LENGTH);
    assert!(error_of(&head[..head.len() - ROWS * ROW]).contains("no row after the header"));
}
