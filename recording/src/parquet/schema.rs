//! Types and units of Parquet columns.

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type as Physical};
use parquet::schema::types::ColumnDescriptor;

/// Returns the unit of a time or timestamp column from its type.
pub(super) fn unit(column: &ColumnDescriptor) -> Option<String> {
    let unit = match column.logical_type_ref() {
        Some(LogicalType::Timestamp(stamp)) => Some(&stamp.unit),
        Some(LogicalType::Time(time)) => Some(&time.unit),
        _ => None,
    };
    let name = match (unit, column.converted_type()) {
        (Some(TimeUnit::MILLIS), _)
        | (None, ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIME_MILLIS) => "ms",
        (Some(TimeUnit::MICROS), _)
        | (None, ConvertedType::TIMESTAMP_MICROS | ConvertedType::TIME_MICROS) => "us",
        (Some(TimeUnit::NANOS), _) => "ns",
        (None, _) if column.physical_type() == Physical::INT96 => "ns",
        (None, _) => return None,
    };
    Some(name.to_owned())
}

pub(super) fn is_instant(column: &ColumnDescriptor) -> bool {
    matches!(column.logical_type_ref(), Some(LogicalType::Timestamp(_)))
        || matches!(
            column.converted_type(),
            ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIMESTAMP_MICROS
        )
}

pub(super) fn is_number(column: &ColumnDescriptor) -> bool {
    // Old programs write only Parquet's older "converted types". Decimals are excluded because their values are scaled
    // integers.
    let has_other_type = ![
        ConvertedType::NONE,
        ConvertedType::INT_8,
        ConvertedType::INT_16,
        ConvertedType::INT_32,
        ConvertedType::INT_64,
        ConvertedType::UINT_8,
        ConvertedType::UINT_16,
        ConvertedType::TIME_MILLIS,
        ConvertedType::TIME_MICROS,
        ConvertedType::TIMESTAMP_MILLIS,
        ConvertedType::TIMESTAMP_MICROS,
    ]
    .contains(&column.converted_type());
    let is_plain = match column.logical_type_ref() {
        _ if has_other_type => false,
        None | Some(LogicalType::Timestamp(_) | LogicalType::Time(_)) => true,
        // Large unsigned integers of 32 or 64 bits would be read as negative numbers.
        Some(LogicalType::Integer(integer)) => integer.is_signed || integer.bit_width < 32,
        Some(_) => false,
    };
    let physical = [
        Physical::INT32,
        Physical::INT64,
        Physical::INT96,
        Physical::FLOAT,
        Physical::DOUBLE,
    ];
    is_plain && column.max_rep_level() == 0 && physical.contains(&column.physical_type())
}

pub(super) fn kind(column: &ColumnDescriptor) -> String {
    match (column.logical_type_ref(), column.physical_type()) {
        (Some(LogicalType::Timestamp(_)), _) | (None, Physical::INT96) => "timestamp".into(),
        (Some(LogicalType::Time(_)), _) => "time".into(),
        (Some(LogicalType::String), _) => "text".into(),
        (_, Physical::DOUBLE) => "f64".into(),
        (_, Physical::FLOAT) => "f32".into(),
        (None, Physical::INT32) => "i32".into(),
        (None, Physical::INT64) => "i64".into(),
        (_, other) => other.to_string().to_ascii_lowercase(),
    }
}
