//! Random MDF4 files and damaged copies of them have the rows that asammdf reads, or are refused.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use dashpot_files::FileError;
use dashpot_recording::{Channel, Channels, Quantity, Recording};
use xtask::python::have_packages;

use crate::python::run;

/// Files and damaged copies; `found.py` determines each by its number.
const FILES: usize = 320;
const COPIES: usize = 2000;

/// Damaged files that asammdf 8.8.28 reads wrong: it drops a conversion whose name cannot be read.
const IS_WRONG: [&str; 1] = ["damaged_1464"];

/// Rounding may differ where a conversion has several operations.
const TOLERANCE: f64 = 1e-12;

/// Rows of a channel: times and values, both finite.
type Rows = Vec<[f64; 2]>;

/// Returns the rows of each channel as asammdf reads them, without invalid ones.
fn answers(path: &Path) -> BTreeMap<String, Rows> {
    let bytes = std::fs::read(path.with_extension("answer")).unwrap();
    let mut rest = &bytes[..];
    let mut take = |count: usize| {
        let (taken, after) = rest.split_at(count);
        rest = after;
        taken
    };
    let mut answers = BTreeMap::new();
    let mut left = bytes.len();
    while left > 0 {
        let [name, rows] = [0; 2].map(|_: i32| {
            let bytes = take(4).try_into().unwrap();
            u32::from_le_bytes(bytes) as usize
        });
        left -= 8 + name + 16 * rows;
        let name = String::from_utf8(take(name).to_vec()).unwrap();
        let [times, values] = [0; 2].map(|_: i32| {
            let numbers = take(8 * rows).chunks_exact(8);
            numbers
                .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
                .collect::<Vec<_>>()
        });
        let rows = times
            .into_iter()
            .zip(values)
            .map(|(time, value)| [time, value]);
        let rows = rows.filter(|row| row.iter().all(|number| number.is_finite()));
        answers.insert(name, rows.collect());
    }
    answers
}

/// Reads a channel, whatever its unit. The flag is true if a warning says that the end of the rows is uncertain.
fn read(path: &Path, name: &str) -> Result<(Rows, bool), String> {
    let channel = |name: Option<&str>, quantity: Quantity| Channel {
        name: name.map(str::to_owned),
        unit: Some(quantity.units()[0]),
        ..Channel::default()
    };
    let channels = Channels {
        time: channel(None, Quantity::Time),
        displacement: channel(Some(name), Quantity::Displacement),
        skip_invalid: true,
        ..Channels::default()
    };
    let words = |error: FileError| error.to_string();
    let mut file = Recording::open_with(path, &channels).map_err(words)?;
    let rows = file.read_all().map_err(words)?;
    let rows = rows.iter().map(|row| [row.time_s, row.displacement_m]);
    Ok((rows.collect(), file.gaps().unfinished.is_some()))
}

fn is_same(rows: &Rows, expected: &Rows) -> bool {
    let is_near = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= TOLERANCE * b.abs();
    rows.len() == expected.len()
        && rows
            .iter()
            .zip(expected)
            .all(|(a, b)| a.iter().zip(b).all(is_near))
}

/// Files whose names begin with `start`.
fn files(folder: &Path, start: char) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let is_it = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name.ends_with(".mf4") && name.starts_with(start)
    };
    let mut files: Vec<PathBuf> = entries.filter(is_it).collect();
    files.sort();
    files
}

#[test]
fn files_as_they_are_found_have_the_rows_of_asammdf() {
    let Some(python) = have_packages("asammdf reading random and damaged files") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let [files_wanted, copies] = [FILES, COPIES].map(|count| count.to_string());
    let path = folder.path().to_str().unwrap();
    run(python, "found.py", &[path, &files_wanted, &copies]);
    let (mut answered, mut channels) = (0, 0);
    let whole = files(folder.path(), '0');
    assert_eq!(whole.len(), FILES);
    for path in whole {
        let answers = answers(&path);
        answered += usize::from(!answers.is_empty());
        for (name, expected) in &answers {
            let file = path.display();
            match read(&path, name) {
                Ok((rows, _)) => assert!(is_same(&rows, expected), "{file}: {name}"),
                // A file without valid rows is refused.
                Err(error) => assert!(expected.is_empty(), "{name}: {error}"),
            }
            channels += 1;
        }
    }
    // asammdf cannot finish all files whose lists lack links.
    assert!(
        answered >= 290 && channels >= 1500,
        "{answered} files, {channels} channels"
    );
    compare_damaged(folder.path());
}

/// Compares two channels of each damaged file. Neither program may read other numbers than the other without a warning.
fn compare_damaged(folder: &Path) {
    let (mut same, mut refused) = (0, 0);
    let damaged = files(folder, 'd');
    assert_eq!(damaged.len(), COPIES);
    for path in damaged {
        let answers = answers(&path);
        let name = path.file_stem().unwrap().to_str().unwrap();
        for channel in ["x", "F"] {
            let read = read(&path, channel);
            let (rows, is_warned) = match (read, answers.get(channel)) {
                (Ok(read), Some(_)) => read,
                (Err(_), _) => {
                    refused += 1;
                    continue;
                }
                (Ok(_), None) => continue,
            };
            let is_same = is_same(&rows, &answers[channel]);
            same += usize::from(is_same);
            assert!(
                is_same || is_warned || IS_WRONG.contains(&name),
                "{name}: {channel}"
            );
        }
    }
    assert!(
        same >= 600 && refused >= 1000,
        "{same} read alike, {refused} refused"
    );
}
