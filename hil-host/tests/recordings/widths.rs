//! MDF4 integers of every width from 1 to 64 bits, signed and unsigned, little- and big-endian, at every bit offset;
//! and floats.

use std::path::Path;

use dashpot_recording::{Channel, Channels, Recording};
use xtask::python::have_packages;

use crate::mdf4::{self, Channel as Field};
use crate::python::run;

const ROWS: usize = 12;

/// A channel with the raw bits and the value of each row.
struct Column {
    field: Field,
    raw: Vec<u128>,
    numbers: Vec<f64>,
}

/// Pseudo-random bits (SplitMix64).
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn columns() -> Vec<Column> {
    let mut state = 26;
    let mut byte = 8;
    let mut columns = Vec::new();
    let mut add = |number: u8, bit: u32, bits: u32, numbers: &dyn Fn(u64) -> (u128, f64)| {
        let rows = (0..ROWS).map(|row| match row {
            0 => u64::MAX,
            1 => 0,
            2 => 1 << (bits - 1),
            3 => (1 << (bits - 1)) - 1,
            _ => random(&mut state),
        });
        let (raw, numbers) = rows.map(numbers).unzip();
        let name = format!("{number}_{bits}_{bit}");
        columns.push(Column {
            field: Field::value(&name, number, [byte, bit, bits]),
            raw,
            numbers,
        });
        byte += (bit + bits).div_ceil(8);
    };
    for number in 0..4 {
        for bits in [
            1, 3, 7, 8, 9, 12, 15, 16, 17, 20, 24, 29, 31, 32, 33, 40, 47, 48, 53, 56, 63, 64,
        ] {
            for bit in 0..8 {
                add(number, bit, bits, &|random| {
                    let mask = u64::MAX >> (64 - bits);
                    let shift = 64 - bits;
                    let value = random & mask;
                    let signed = ((value << shift) as i64) >> shift;
                    let number = match number {
                        0 | 1 => value as f64,
                        _ => signed as f64,
                    };
                    (u128::from(value), number)
                });
            }
        }
    }
    for number in 4..6 {
        // Clear one bit of the exponent, so that all values are finite.
        add(number, 0, 32, &|random| {
            let bits = random as u32 & !(1 << 26);
            (u128::from(bits), f64::from(f32::from_bits(bits)))
        });
        add(number, 0, 64, &|random| {
            let bits = random & !(1 << 54);
            (u128::from(bits), f64::from_bits(bits))
        });
    }
    columns
}

/// Writes widths.mf4 and widths.csv.
fn write(folder: &Path, columns: &[Column]) {
    let record = |row: usize| {
        let mut record = (row as f64 / 1e3).to_le_bytes().to_vec();
        for Column { field, raw, .. } in columns {
            let bits = raw[row] << field.bit;
            let count = (u32::from(field.bit) + field.bits).div_ceil(8) as usize;
            let bytes = bits.to_le_bytes();
            match field.number % 2 {
                0 => record.extend(&bytes[..count]),
                _ => record.extend(bytes[..count].iter().rev()),
            }
        }
        record
    };
    let records: Vec<Vec<u8>> = (0..ROWS).map(record).collect();
    let mut fields = vec![Field::time()];
    fields.extend(columns.iter().map(|Column { field, .. }| Field {
        name: field.name.clone(),
        ..*field
    }));
    mdf4::write(&folder.join("widths.mf4"), &fields, &records);
    let mut csv = csv::Writer::from_path(folder.join("widths.csv")).unwrap();
    csv.write_record(columns.iter().map(|column| &column.field.name))
        .unwrap();
    for row in 0..ROWS {
        let cells = columns.iter().map(|column| column.numbers[row].to_string());
        csv.write_record(cells).unwrap();
    }
    csv.flush().unwrap();
}

#[test]
fn every_width_and_bit_offset_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let columns = columns();
    write(folder.path(), &columns);
    for column in &columns {
        let channels = Channels {
            displacement: Channel {
                name: Some(column.field.name.clone()),
                ..Channel::default()
            },
            ..Channels::default()
        };
        let path = folder.path().join("widths.mf4");
        let mut recording = Recording::open_with(&path, &channels).unwrap();
        let rows = recording.read_all().unwrap();
        let found: Vec<f64> = rows.iter().map(|row| row.displacement_m).collect();
        assert_eq!(found, column.numbers, "{}", column.field.name);
    }
}

#[test]
fn asammdf_reads_the_same() {
    let Some(python) = have_packages("asammdf reading numbers of every width") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &columns());
    run(python, "widths.py", &[folder.path().to_str().unwrap()]);
}
