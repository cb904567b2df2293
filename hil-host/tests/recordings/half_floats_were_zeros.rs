//! Regression: 16-bit floats in MDF4 were read as zeros, and so were floats of widths other than 32 and 64 bits.

use std::path::Path;

use dashpot_recording::{Channel, Channels, Quantity, Recording, overview};

use crate::common::{dashpot, error_of, text_of};
use crate::forms::{rows, samples};
use crate::mdf4::{self, Channel as Field};

fn displacements(path: &Path, name: &str) -> Result<Vec<f64>, String> {
    let channels = Channels {
        displacement: Channel {
            name: Some(name.into()),
            ..Channel::default()
        },
        ..Channels::default()
    };
    let rows = Recording::open_with(path, &channels).and_then(|mut recording| recording.read_all());
    let rows = rows.map_err(|error| error.to_string())?;
    Ok(rows.iter().map(|row| row.displacement_m).collect())
}

fn record(row: usize, field: &[u8]) -> Vec<u8> {
    [&(row as f64 / 1e3).to_le_bytes()[..], field].concat()
}

/// Files written by asammdf, little- and big-endian.
#[test]
fn half_floats_of_another_program_are_read() {
    let expected = rows(&samples().join("expected.csv"), &Channels::default()).unwrap();
    let channels = |displacement: &str| Channels {
        displacement: Channel {
            name: Some(displacement.into()),
            unit: Quantity::Displacement.unit("mm"),
            reversed: false,
        },
        ..Channels::default()
    };
    for name in ["Weg", "geW"] {
        let path = samples().join("halves.mf4");
        let found = Recording::open_with(&path, &channels(name)).unwrap();
        let found: Vec<f64> = { found }
            .read_all()
            .unwrap()
            .iter()
            .map(|row| row.displacement_m)
            .collect();
        let expected: Vec<f64> = expected.iter().map(|row| row.displacement_m).collect();
        assert_eq!(found, expected, "{name}");
    }
}

/// Compares every finite half-precision number with its definition: 2^(e - 25) times 1024 + f, or 2^-24 times f if e is
/// 0.
#[test]
fn every_half_has_its_value() {
    let folder = tempfile::tempdir().unwrap();
    for (number, is_big) in [(4, false), (5, true)] {
        let path = folder.path().join("halves.mf4");
        let finite = (0..=u16::MAX).filter(|bits| bits >> 10 & 31 != 31);
        let halves: Vec<u16> = finite.collect();
        let bytes = |bits: u16| match is_big {
            true => bits.to_be_bytes(),
            false => bits.to_le_bytes(),
        };
        let records = halves.iter().enumerate();
        let records: Vec<Vec<u8>> = records
            .map(|(row, bits)| record(row, &bytes(*bits)))
            .collect();
        let scaled = Field {
            linear: Some([0.5, 2.0]),
            ..Field::value("scaled", number, [8, 0, 16])
        };
        let plain = Field::value("plain", number, [8, 0, 16]);
        mdf4::write(&path, &[Field::time(), plain, scaled], &records);
        let value = |bits: &u16| {
            let (e, f) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
            let size = match e {
                0 => f / 2.0_f64.powi(24),
                _ => (1024.0 + f) * 2.0_f64.powi(e - 25),
            };
            if *bits > 0x7fff { -size } else { size }
        };
        let expected: Vec<f64> = halves.iter().map(value).collect();
        assert_eq!(displacements(&path, "plain").unwrap(), expected);
        let expected: Vec<f64> = expected.iter().map(|value| 2.0 * value + 0.5).collect();
        assert_eq!(displacements(&path, "scaled").unwrap(), expected);
    }
}

#[test]
fn other_widths_and_bit_offsets_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("odd.mf4");
    let records: Vec<Vec<u8>> = (0..9).map(|row| record(row, &[1; 16])).collect();
    let cases = [
        (
            4,
            [8, 0, 24],
            "floats of 24 bits, allowed: 16, 32 or 64 bits",
        ),
        (
            5,
            [8, 0, 80],
            "floats of 80 bits, allowed: 16, 32 or 64 bits",
        ),
        (
            4,
            [8, 3, 32],
            "floats that start at bit 3 of a byte, allowed: bit 0",
        ),
        (
            0,
            [8, 0, 80],
            "whole numbers of 80 bits, allowed: 1 to 64 bits",
        ),
        (
            2,
            [8, 0, 0],
            "whole numbers of 0 bits, allowed: 1 to 64 bits",
        ),
        (
            3,
            [8, 9, 8],
            "whole numbers that start at bit 9 of a byte, allowed: bits 0 to 7",
        ),
        (
            0,
            [23, 1, 8],
            "numbers up to byte 25 of records of 24 bytes, allowed: numbers within their record",
        ),
        (
            4,
            [20, 0, 64],
            "numbers up to byte 28 of records of 24 bytes, allowed: numbers within their record",
        ),
    ];
    for (number, place, expected) in cases {
        mdf4::write(
            &path,
            &[Field::time(), Field::value("Weg", number, place)],
            &records,
        );
        let error = displacements(&path, "Weg").unwrap_err();
        let expected = format!("odd.mf4: displacement: channel Weg contains {expected}");
        assert!(error.ends_with(&expected), "{error}");
        // The other channels are read, and the list names the unreadable one.
        let list = overview(&path, &Channels::default()).unwrap();
        assert_eq!(list.channels[0].first, Some(0.0));
        assert_eq!((list.channels[1].first, list.channels[1].rows), (None, 9));
        let listed = text_of(&dashpot(&["channels", "odd.mf4"], folder.path()).success());
        let reason = expected.split_once(" contains ").unwrap().1;
        assert!(
            listed.contains(&format!("warning: channel Weg is not read: {reason}")),
            "{listed}"
        );
        let arguments = ["replay", "--input", "odd.mf4", "--displacement", "Weg"];
        let output = ["--output", "force.csv"];
        let ended = dashpot(&[&arguments[..], &output].concat(), folder.path());
        let error = error_of(&ended);
        assert!(
            error.contains(reason) && error.contains("choose one with --displacement NAME"),
            "{error}"
        );
        ended.code(1);
    }
}
