//! Cached tables: identical bits, identified by content, replaced if damaged, bounded, and never needed.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, SystemTime};

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables};

use crate::common::{geometry, tables};

/// Content of the file of the shipped pair.
fn bytes() -> &'static [u8] {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| tables().to_bytes())
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().path()).collect()
}

fn cached(folder: &Path) -> Tables {
    let cached = Tables::cached(folder, geometry().clone());
    cached.is_kept.unwrap();
    cached.tables
}

#[test]
fn a_file_is_short_and_gives_the_same_bits() {
    assert!(bytes().len() <= 1_500_000, "{} bytes", bytes().len());
    let again = Tables::from_bytes(geometry().clone(), bytes()).unwrap();
    assert!(again == *tables());
    assert!(again.bytes() <= 5_000_000);
}

#[test]
fn bytes_of_other_profiles_or_with_errors_are_refused() {
    let wider = Installation::default().with_gauge_m(1.436);
    let other = ContactGeometry::new(Pair::standard(wider).unwrap(), Steel::default()).unwrap();
    assert!(Tables::from_bytes(other.clone(), bytes()).is_err());
    assert_ne!(Tables::file_name(&other), Tables::file_name(geometry()));
    let refused = |bytes: &[u8]| Tables::from_bytes(geometry().clone(), bytes).is_err();
    for length in [0, 15, 16, 48, 80, 81, bytes().len() / 2, bytes().len() - 1] {
        assert!(refused(&bytes()[..length]), "{length}");
    }
    for position in [0, 15, 20, 50, 80, 1000, bytes().len() - 1] {
        let mut flipped = bytes().to_vec();
        flipped[position] ^= 1;
        assert!(refused(&flipped), "{position}");
    }
}

#[test]
fn tables_are_computed_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().join("made/on/demand");
    let first = cached(&folder);
    let [written] = <[PathBuf; 1]>::try_from(files(&folder)).unwrap();
    assert_eq!(fs::read(&written).unwrap(), bytes());
    // The file that is read is not written again, but its time tells that it was used.
    let long_ago = SystemTime::now() - Duration::from_secs(1_000_000);
    File::options()
        .write(true)
        .open(&written)
        .and_then(|file| file.set_modified(long_ago))
        .unwrap();
    assert!(cached(&folder) == first);
    let used = fs::metadata(&written).unwrap().modified().unwrap();
    assert!(used > long_ago + Duration::from_secs(1000));
    // A damaged file is replaced.
    fs::write(&written, &bytes()[..1000]).unwrap();
    assert!(cached(&folder) == first);
    assert_eq!(fs::read(&written).unwrap(), bytes());
}

#[test]
fn the_files_not_used_for_longest_go() {
    let folder = tempfile::tempdir().unwrap();
    let now = SystemTime::now();
    let megabytes = |name: &str, megabytes: u64, age_s: u64| {
        let path = folder.path().join(name);
        let file = File::create_new(&path).unwrap();
        file.set_len(megabytes * 1_000_000).unwrap();
        file.set_modified(now - Duration::from_secs(age_s)).unwrap();
        path
    };
    let [oldest, left_over, young] = [
        megabytes("oldest.tables", 60, 300),
        megabytes("left-over.part", 60, 200),
        megabytes("young.tables", 60, 100),
    ];
    let foreign = megabytes("notes.txt", 200, 1000);
    cached(folder.path());
    assert!(!oldest.exists() && !left_over.exists());
    assert!(young.exists() && foreign.exists());
    assert!(folder.path().join(Tables::file_name(geometry())).exists());
}

#[test]
fn an_unusable_folder_only_costs_time() {
    let folder = tempfile::tempdir().unwrap();
    let occupied = folder.path().join("occupied");
    fs::write(&occupied, "a file").unwrap();
    let cached = Tables::cached(&occupied.join("tables"), geometry().clone());
    assert!(cached.tables == *tables());
    let reason = cached.is_kept.unwrap_err().to_string();
    assert!(reason.contains("occupied"), "{reason}");
}
