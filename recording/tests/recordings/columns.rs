//! Tables converted from CSV to Parquet.

use std::fmt::Write;
use std::fs::File;

use dashpot_recording::columns;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

/// Converts a CSV table, in which the columns `texts` are text. Returns the Parquet file.
fn converted(table: &str, texts: &[&str]) -> SerializedFileReader<File> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (from, to) = (folder.path().join("a.csv"), folder.path().join("a.parquet"));
    std::fs::write(&from, table).expect("a writable folder");
    columns::write(&from, &to, texts).expect("a valid table");
    let file = File::open(to).expect("a written file");
    SerializedFileReader::new(file).expect("a Parquet file")
}

fn rows(file: &SerializedFileReader<File>) -> Vec<Vec<Field>> {
    let rows = file.get_row_iter(None).expect("rows");
    rows.map(|row| {
        let row = row.expect("a valid row");
        row.get_column_iter()
            .map(|(_, field)| field.clone())
            .collect()
    })
    .collect()
}

/// A digest of digits only must keep its zeros; a column with one word is text, and so is a column without any number.
#[test]
fn columns_are_numbers_only_if_no_cell_is_a_word() {
    let table = "force_n,gap,note,empty,digest\n1.5,2,7,,0012\n-2e3,,end,,0034\n";
    let number = Field::Double;
    let text = |text: &str| Field::Str(text.into());
    let expected = [
        [number(1.5), number(2.0), text("7"), text(""), text("0012")],
        [
            number(-2e3),
            Field::Null,
            text("end"),
            text(""),
            text("0034"),
        ],
    ];
    assert_eq!(rows(&converted(table, &["digest"])), expected);
}

/// A row group, and so the memory for it, holds at most 16 384 rows.
#[test]
fn tables_are_written_in_groups_of_rows() {
    let mut table = String::from("row\n");
    for row in 0..20_000 {
        writeln!(table, "{row}").expect("a text grows");
    }
    let file = converted(&table, &[]);
    let groups = file.metadata().row_groups().iter();
    let counts: Vec<i64> = groups.map(|group| group.num_rows()).collect();
    assert_eq!(counts, [16_384, 3_616]);
    let expected = (0..20_000).map(|row| vec![Field::Double(f64::from(row))]);
    assert!(rows(&file).into_iter().eq(expected));
}
