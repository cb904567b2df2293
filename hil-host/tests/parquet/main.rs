//! `--parquet` of `dashpot vehicle` and `dashpot sweep`, in a build with the feature.

#[path = "../common/mod.rs"]
mod common;

use std::fs::File;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

use crate::common::dashpot;

#[test]
fn history_parquet_has_the_numbers_of_history_csv() {
    let folder = tempfile::tempdir().unwrap();
    // More rows than fit into one row group.
    let case = ["vehicle", "--case", "straight-180", "--duration-s", "0.35"];
    let options = ["--step-us", "20", "--no-page", "--parquet", "--output", "."];
    dashpot(&[&case[..], &options].concat(), folder.path())
        .success()
        .stdout(predicates::str::contains("wrote ./history.parquet"));
    let mut rows = csv::Reader::from_path(folder.path().join("history.csv")).unwrap();
    let file = File::open(folder.path().join("history.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let metadata = reader.metadata().file_metadata();
    let columns = metadata.schema_descr().columns().iter();
    let names: Vec<&str> = columns.map(|column| column.name()).collect();
    assert_eq!(names, rows.headers().unwrap().iter().collect::<Vec<_>>());
    assert_eq!(metadata.num_rows(), 17_500);
    assert_eq!(reader.num_row_groups(), 2);
    let mut found = reader.get_row_iter(None).unwrap();
    for row in rows.records() {
        let found = found.next().unwrap().unwrap();
        for (number, cell) in row.unwrap().iter().enumerate() {
            let expected: f64 = cell.parse().unwrap();
            assert_eq!(found.get_double(number).unwrap(), expected, "{number}");
        }
    }
    assert!(found.next().is_none());
}

#[test]
fn rows_parquet_has_numbers_words_and_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let study = r#"name = "small"
seeds = [1, 2]
observed = ["body_vertical_rms_m_per_s2", "last_lateral_m"]
[[sweep]]
name = "a, with a comma"
track = "straight"
speed_km_h = 120
duration_s = 0.2
vary = [{ parameter = "vertical.mount.clearance_m", values = [1e-3, 2e-3] }]
[[sweep]]
name = "b"
track = "straight"
speed_km_h = 120
duration_s = 0.2
"#;
    std::fs::write(folder.path().join("study.toml"), study).unwrap();
    let sweep = ["sweep", "study.toml", "--parquet", "--output", "."];
    dashpot(&sweep, folder.path()).success();
    let mut rows = csv::Reader::from_path(folder.path().join("rows.csv")).unwrap();
    let reader = SerializedFileReader::new(File::open(folder.path().join("rows.parquet")).unwrap());
    let reader = reader.unwrap();
    let mut found = reader.get_row_iter(None).unwrap();
    let names = rows.headers().unwrap().clone();
    let mut count = 0;
    for row in rows.records() {
        let found = found.next().unwrap().unwrap();
        count += 1;
        for (number, cell) in row.unwrap().iter().enumerate() {
            let is_word = [
                "sweep",
                "ending",
                "study",
                "version",
                "physics",
                "row_digest",
            ]
            .contains(&&names[number]);
            if is_word {
                assert_eq!(found.get_string(number).unwrap(), cell);
            } else if cell.is_empty() {
                assert!(found.get_double(number).is_err(), "{}", &names[number]);
            } else {
                assert_eq!(
                    found.get_double(number).unwrap(),
                    cell.parse::<f64>().unwrap()
                );
            }
        }
    }
    assert_eq!(count, 6);
    assert!(found.next().is_none());
}
