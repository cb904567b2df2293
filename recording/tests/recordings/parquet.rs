//! Parquet files of other programs: types and units of columns.

use std::io::{Cursor, Write};
use std::path::Path;
use std::sync::Arc;

use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_recording::{Channels, Recording, overview};
use flate2::Compression;
use flate2::write::GzEncoder;
use parquet::data_type::{DoubleType, FloatType, Int32Type, Int64Type, Int96, Int96Type};
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use tempfile::NamedTempFile;

/// Returns the bytes of a file with three rows: times in a column of type `time`, displacements of 1, 2 and 3 m, and
/// numbers 4, null and 6.
fn file(time: &str, times: &[i64]) -> Vec<u8> {
    let schema = format!(
        "message table {{ required int64 time ({time}); required float displacement_m; optional int32 count; }}"
    );
    let schema = parse_message_type(&schema).expect("a schema");
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer =
        SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties).expect("memory");
    let mut group = writer.next_row_group().expect("memory");
    let mut column = group.next_column().expect("memory").expect("a column");
    let typed = column.typed::<Int64Type>();
    typed.write_batch(times, None, None).expect("memory");
    column.close().expect("memory");
    let mut column = group.next_column().expect("memory").expect("a column");
    let typed = column.typed::<FloatType>();
    let written = typed.write_batch(&[1.0, 2.0, 3.0], None, None);
    written.expect("memory");
    column.close().expect("memory");
    let mut column = group.next_column().expect("memory").expect("a column");
    let typed = column.typed::<Int32Type>();
    let written = typed.write_batch(&[4, 6], Some(&[1, 0, 1]), None);
    written.expect("memory");
    column.close().expect("memory");
    group.close().expect("memory");
    writer.into_inner().expect("memory")
}

fn written(bytes: &[u8]) -> NamedTempFile {
    let mut file = NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("a writable file");
    file
}

/// The types of time columns are the only statement of their unit.
#[test]
fn units_of_times_follow_from_their_types() {
    for (kind, first_s, step_s) in [
        ("TIME(MICROS,true)", 2e-6, 1e-6),
        ("TIME(NANOS,true)", 2e-9, 1e-9),
        // Timestamps count from the first one.
        ("TIMESTAMP(MILLIS,true)", 0.0, 1e-3),
        ("TIMESTAMP(MICROS,true)", 0.0, 1e-6),
        ("TIMESTAMP(NANOS,true)", 0.0, 1e-9),
    ] {
        let file = written(&file(kind, &[2, 3, 4]));
        let mut recording = Recording::open(file.path()).expect(kind);
        let rows = recording.read_all().expect("valid rows");
        for (row, sample) in rows.iter().enumerate() {
            let expected_s = first_s + step_s * row as f64;
            assert!((sample.time_s - expected_s).abs() < 1e-20, "{kind}");
            assert_eq!(sample.displacement_m, 1.0 + row as f64);
        }
        assert_eq!(rows.len(), 3);
    }
}

#[test]
fn an_overview_states_the_types_of_columns() {
    let file = written(&file("TIME(NANOS,true)", &[2, 3, 4]));
    let overview = overview(file.path(), &Channels::default()).expect("a file");
    let channels = overview.channels.iter();
    let found: Vec<_> = channels
        .map(|channel| {
            let range = [channel.first, channel.last].map(|number| number.expect("a number"));
            (channel.kind.as_str(), range, channel.invalid, channel.group)
        })
        .collect();
    assert_eq!(
        found,
        [
            ("time", [2.0, 4.0], 0, None),
            ("f32", [1.0, 3.0], 0, None),
            ("i32", [4.0, 6.0], 1, None),
        ]
    );
    assert_eq!(overview.unended_line, None);
}

/// Returns a file with these numbers in an optional column, in row groups and pages of other sizes than those in which
/// the reader reads, and the times 0, 1, 2 and so on.
fn with_nulls(numbers: &[Option<f64>]) -> Vec<u8> {
    let schema = "message table { required double time_s; optional double displacement_m; }";
    let schema = parse_message_type(schema).expect("a schema");
    let properties = WriterProperties::builder()
        .set_data_page_row_count_limit(1000)
        .set_write_batch_size(100)
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))
        .expect("memory");
    let mut first = 0;
    for part in numbers.chunks(15_000) {
        let mut group = writer.next_row_group().expect("memory");
        let times: Vec<f64> = (first..first + part.len()).map(|row| row as f64).collect();
        first += part.len();
        let mut column = group.next_column().expect("memory").expect("a column");
        let typed = column.typed::<DoubleType>();
        typed.write_batch(&times, None, None).expect("memory");
        column.close().expect("memory");
        let levels: Vec<i16> = part
            .iter()
            .map(|number| i16::from(number.is_some()))
            .collect();
        let values: Vec<f64> = part.iter().copied().flatten().collect();
        let mut column = group.next_column().expect("memory").expect("a column");
        let typed = column.typed::<DoubleType>();
        let written = typed.write_batch(&values, Some(&levels), None);
        written.expect("memory");
        column.close().expect("memory");
        group.close().expect("memory");
    }
    writer.into_inner().expect("memory")
}

/// The first null or number in the wrong row would shift all those after it.
#[test]
fn nulls_keep_their_rows_across_pages_and_row_groups() {
    let number = |row: u32| (row % 7 != 3).then(|| 0.5 * f64::from(row));
    let numbers: Vec<Option<f64>> = (0..20_000).map(number).collect();
    let source = Box::new(Cursor::new(with_nulls(&numbers)));
    let skipping = Channels {
        skip_invalid: true,
        ..Channels::default()
    };
    let mut recording =
        Recording::read_with(Path::new("run7.parquet"), source, &skipping).expect("a file");
    let rows = recording.read_all().expect("valid rows");
    let found = rows.iter().map(|row| (row.time_s, row.displacement_m));
    let expected = (0..20_000).filter_map(|row| Some((f64::from(row), number(row)?)));
    assert!(found.eq(expected));
}

/// The memory for a file does not grow with its rows, because each row group is written when it is full.
#[test]
fn written_files_have_groups_of_65536_rows() {
    let columns = [Column::new("time_s", "s")];
    let mut bytes = Vec::new();
    let path = Path::new("forces.parquet");
    let mut writer =
        RowWriter::new(path, &mut bytes, FileFormat::Parquet, &columns).expect("memory");
    for row in 0..70_000 {
        let values = [f64::from(row)];
        writer.row(&values, values).expect("memory");
    }
    writer.finish().expect("memory");
    let file = written(&bytes).into_file();
    let file = SerializedFileReader::new(file).expect("a file");
    let groups = file.metadata().row_groups().iter();
    let counts: Vec<i64> = groups.map(|group| group.num_rows()).collect();
    assert_eq!(counts, [65_536, 4_464]);
}

/// Parquet needs random access, which a compressed file does not offer.
#[test]
fn compressed_files_are_read_from_a_copy() {
    let bytes = file("TIME(MICROS,true)", &[2, 3, 4]);
    let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
    gzip.write_all(&bytes).expect("memory");
    let compressed = written(&gzip.finish().expect("memory"));
    for file in [compressed, written(&bytes)] {
        let mut recording = Recording::open(file.path()).expect("a file");
        assert_eq!(recording.read_all().expect("valid rows").len(), 3);
    }
}

/// Old programs write timestamps as a Julian day and the nanoseconds in it.
#[test]
fn timestamps_of_96_bits_count_from_the_first() {
    let schema = "message table { required int96 time; required float displacement_m; }";
    let schema = parse_message_type(schema).expect("a schema");
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer =
        SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties).expect("memory");
    let mut group = writer.next_row_group().expect("memory");
    let mut column = group.next_column().expect("memory").expect("a column");
    // One nanosecond before midnight, midnight, and one second later.
    let ns = 86_400_000_000_000_u64 - 1;
    let stamps = [(ns, 2_461_373), (0, 2_461_374), (1_000_000_000, 2_461_374)]
        .map(|(ns, day)| Int96::from(vec![ns as u32, (ns >> 32) as u32, day]));
    let typed = column.typed::<Int96Type>();
    typed.write_batch(&stamps, None, None).expect("memory");
    column.close().expect("memory");
    let mut column = group.next_column().expect("memory").expect("a column");
    let typed = column.typed::<FloatType>();
    let written = typed.write_batch(&[1.0, 2.0, 3.0], None, None);
    written.expect("memory");
    column.close().expect("memory");
    group.close().expect("memory");
    let bytes = writer.into_inner().expect("memory");
    let source = Box::new(Cursor::new(bytes));
    let mut recording = Recording::read(Path::new("run7.parquet"), source).expect("a file");
    let rows = recording.read_all().expect("rows");
    let times_s: Vec<f64> = rows.iter().map(|row| row.time_s).collect();
    assert_eq!(times_s, [0.0, 1e-9, 1.000_000_001]);
}
