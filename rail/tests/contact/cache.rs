//! Cached tables: identical bits, identified by content, replaced if damaged.

use std::fs;
use std::path::{Path, PathBuf};

use dashpot_rail::contact::{
    CacheError, ContactGeometry, Grid, Installation, Pair, Steel, Tables, WheelPose,
};

fn grid() -> Grid {
    let mut grid = Grid::default();
    grid.lateral_m.cells = [20, 60, 10];
    grid.roll_rad.cells = [1, 2, 1];
    grid.yaw_squared_rad2.cells = [0, 1, 1];
    grid
}

fn geometry(nominal_load_n: f64) -> ContactGeometry {
    let pair = Pair::standard(Installation::default()).unwrap();
    ContactGeometry::new(pair, Steel::default(), nominal_load_n).unwrap()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().path()).collect()
}

fn same(a: &Tables, b: &Tables) -> bool {
    (0..400).all(|n| {
        let n = f64::from(n);
        let pose = WheelPose {
            lateral_m: -0.02 + n * 2e-4,
            roll_rad: 0.01 * n.sin(),
            yaw_rad: 0.03 * n.cos(),
        };
        a.at(&pose) == b.at(&pose)
    })
}

#[test]
fn tables_are_identified_by_their_content() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().join("made/on/demand");
    let computed = Tables::new(geometry(100e3), grid()).unwrap();
    let first = Tables::cached(&folder, geometry(100e3), grid()).unwrap();
    let [written] = <[PathBuf; 1]>::try_from(files(&folder)).unwrap();
    let time = fs::metadata(&written).unwrap().modified().unwrap();
    let second = Tables::cached(&folder, geometry(100e3), grid()).unwrap();
    assert!(same(&computed, &first) && same(&computed, &second));
    assert_eq!(fs::metadata(&written).unwrap().modified().unwrap(), time);
    // Another load and another grid need other tables.
    let other = Tables::cached(&folder, geometry(50e3), grid()).unwrap();
    assert!(!same(&computed, &other));
    let mut finer = grid();
    finer.lateral_m.cells[1] += 1;
    Tables::cached(&folder, geometry(100e3), finer).unwrap();
    assert_eq!(files(&folder).len(), 3);
}

#[test]
fn a_wrong_or_damaged_file_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let computed = Tables::cached(folder.path(), geometry(100e3), grid()).unwrap();
    let [file] = <[PathBuf; 1]>::try_from(files(folder.path())).unwrap();
    let whole = fs::read(&file).unwrap();
    let mut flipped = whole.clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    for damaged in [&whole[..whole.len() - 1], &whole[..40], &[], &flipped] {
        fs::write(&file, damaged).unwrap();
        let again = Tables::cached(folder.path(), geometry(100e3), grid()).unwrap();
        assert!(same(&computed, &again));
        assert_eq!(fs::read(&file).unwrap(), whole);
    }
    // A complete file with this key but the nodes of another load, as if another method had computed them.
    let other = tempfile::tempdir().unwrap();
    Tables::cached(other.path(), geometry(90e3), grid()).unwrap();
    let [strange] = <[PathBuf; 1]>::try_from(files(other.path())).unwrap();
    let mut strange = fs::read(strange).unwrap();
    strange[16..48].copy_from_slice(&whole[16..48]);
    fs::write(&file, strange).unwrap();
    let again = Tables::cached(folder.path(), geometry(100e3), grid()).unwrap();
    assert!(same(&computed, &again));
    assert_eq!(fs::read(&file).unwrap(), whole);
}

#[test]
fn an_unusable_folder_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let occupied = folder.path().join("occupied");
    fs::write(&occupied, "a file").unwrap();
    let error = Tables::cached(&occupied.join("tables"), geometry(100e3), grid()).unwrap_err();
    assert!(matches!(error, CacheError::File { .. }), "{error}");
    assert!(error.to_string().contains("occupied"), "{error}");
}
