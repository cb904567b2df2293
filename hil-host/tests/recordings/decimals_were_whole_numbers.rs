//! Regression: Parquet files of old writers mark a decimal, a date or an unsigned 64-bit integer only with the older
//! kind of type annotation. It was ignored, so 1.23 was read as 123.

use std::path::Path;
use std::sync::Arc;

use dashpot_recording::{Channels, Recording};
use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int32Type, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

fn write(path: &Path, physical: Physical, converted: ConvertedType) {
    let column = |name, physical| {
        Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED)
    };
    let mut value = column("displacement_m", physical).with_converted_type(converted);
    if converted == ConvertedType::DECIMAL {
        value = value.with_precision(9).with_scale(2);
    }
    let time = column("time_s", Physical::DOUBLE).build().unwrap();
    let fields = vec![Arc::new(time), Arc::new(value.build().unwrap())];
    let schema = Type::group_type_builder("table")
        .with_fields(fields)
        .build();
    let file = std::fs::File::create(path).unwrap();
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer =
        SerializedFileWriter::new(file, Arc::new(schema.unwrap()), properties).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let mut place = group.next_column().unwrap().unwrap();
    place
        .typed::<DoubleType>()
        .write_batch(&[0.0, 1.0], None, None)
        .unwrap();
    place.close().unwrap();
    let mut place = group.next_column().unwrap().unwrap();
    if physical == Physical::INT32 {
        let place = place.typed::<Int32Type>();
        place.write_batch(&[123, 456], None, None).unwrap();
    } else {
        let place = place.typed::<Int64Type>();
        place.write_batch(&[123, 456], None, None).unwrap();
    }
    place.close().unwrap();
    group.close().unwrap();
    writer.close().unwrap();
}

#[test]
fn numbers_that_are_not_those_of_the_file_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.parquet");
    for (physical, converted, is_read) in [
        (Physical::INT32, ConvertedType::DECIMAL, false),
        (Physical::INT64, ConvertedType::DECIMAL, false),
        (Physical::INT32, ConvertedType::DATE, false),
        (Physical::INT32, ConvertedType::UINT_32, false),
        (Physical::INT64, ConvertedType::UINT_64, false),
        (Physical::INT32, ConvertedType::UINT_16, true),
        (Physical::INT32, ConvertedType::INT_8, true),
        (Physical::INT64, ConvertedType::INT_64, true),
        (Physical::INT64, ConvertedType::NONE, true),
    ] {
        write(&path, physical, converted);
        let read = Recording::open_with(&path, &Channels::default())
            .and_then(|mut recording| recording.read_all());
        match read {
            Ok(rows) => {
                assert!(is_read, "{converted}");
                assert_eq!(rows[1].displacement_m, 456.0);
            }
            Err(error) => {
                let error = error.to_string();
                let expected = "displacement: channel displacement_m contains ";
                assert!(!is_read && error.contains(expected), "{converted}: {error}");
            }
        }
    }
}
