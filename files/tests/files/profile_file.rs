//! Profile files: errors with file, line and column.

use std::fmt::Write;

use dashpot_files::profile;
use dashpot_rail::profile::measured::Options;
use dashpot_rail::profile::{Body, s1002};

#[test]
fn a_wrong_cell_is_reported_with_file_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wheel.csv");
    let mut text = String::from("# a gauge\ny_mm,z_mm\n");
    for y in -68..=60 {
        writeln!(text, "{y},{:.2}", s1002::depth_mm(f64::from(y))).unwrap();
    }
    std::fs::write(&path, &text).unwrap();
    let (wheel, _) = profile::read(&path, Body::Wheel, &Options::default()).unwrap();
    assert_eq!(wheel.name(), "wheel");
    std::fs::write(&path, text.replace("\n-68,", "\nx,")).unwrap();
    let error = profile::read(&path, Body::Wheel, &Options::default()).unwrap_err();
    let expected = format!(
        "{}:3: column y_mm: \"x\" is not a number from -1000 to 1000",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_wrong_line_is_reported_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wheel.whl");
    let text = include_str!("../../../rail/tests/data/s1002.whl");
    std::fs::write(&path, text.replace("Stock=", "Stock")).unwrap();
    let error = profile::read(&path, Body::Wheel, &Options::default()).unwrap_err();
    let expected = format!(
        "{}:2: \"Stock\", allowed: Key=Value, up to an empty line",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn bytes_that_are_not_utf_8_are_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wheel.whl");
    let text = include_str!("../../../rail/tests/data/s1002.whl");
    let latin_1: Vec<u8> = text
        .replace("Stock=", "Stock=K\u{f6}ln")
        .chars()
        .map(|letter| u8::try_from(letter).unwrap())
        .collect();
    std::fs::write(&path, latin_1).unwrap();
    assert!(profile::read(&path, Body::Wheel, &Options::default()).is_ok());
}

#[test]
fn a_missing_file_is_reported_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.csv");
    let error = profile::read(&path, Body::Rail, &Options::default()).unwrap_err();
    assert!(
        error.to_string().contains("none.csv: cannot read"),
        "{error}"
    );
}
