//! `dashpot vehicle --parquet`, in a build with the feature.

#[path = "../common/mod.rs"]
mod common;

use std::fs::File;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

use crate::common::dashpot;

#[test]
fn history_parquet_has_the_numbers_of_history_csv() {
    let folder = tempfile::tempdir().unwrap();
    // More rows than one row group has.
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
