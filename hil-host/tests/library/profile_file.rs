//! Profiles from files: what is wrong is reported with file, line and column.

use std::fmt::Write;

use dashpot_hil::files::profile;
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
    let wheel = profile::read(&path, Body::Wheel, 0.004).unwrap();
    assert_eq!(wheel.name(), "wheel");
    std::fs::write(&path, text.replace("\n-68,", "\nx,")).unwrap();
    let error = profile::read(&path, Body::Wheel, 0.004).unwrap_err();
    let expected = format!(
        "{}:3: column y_mm: \"x\" is not a number from -1000 to 1000",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_missing_file_is_reported_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.csv");
    let error = profile::read(&path, Body::Rail, 0.0).unwrap_err();
    assert!(
        error.to_string().contains("none.csv: cannot read"),
        "{error}"
    );
}
