//! MDF4 files: types, units and groups of channels.

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{
    Channel, Channels, ForceHistory, Measurement, Overview, Quantity, Recording, Remedy, Sample,
    overview, remedy,
};
use falcon_mdf::{Conversion, Mf4Writer, SignalValues};
use tempfile::NamedTempFile;

const TIMES_S: [f64; 3] = [0.0, 1.0, 2.0];

fn bytes(writer: &Mf4Writer) -> Vec<u8> {
    let mut bytes = Vec::new();
    writer.write(&mut bytes).expect("memory");
    bytes
}

/// Returns a file with one group for each list of channels: their names, units and first number; numbers grow by 1.
fn file(groups: &[&[(&str, &str, f64)]]) -> Vec<u8> {
    let mut writer = Mf4Writer::with_start_time_ns(0);
    for channels in groups {
        let group = writer.add_group(&TIMES_S).expect("increasing times");
        for (name, unit, first) in *channels {
            let numbers = TIMES_S.map(|time_s| first + time_s);
            group.add_channel(name, unit, &numbers).expect("numbers");
        }
    }
    bytes(&writer)
}

fn read(bytes: &[u8], channels: &Channels) -> Result<Vec<Sample>, FileError> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Recording::read_with(Path::new("run7.mf4"), source, channels)
        .and_then(|mut recording| recording.read_all())
}

fn error_of(bytes: &[u8], channels: &Channels) -> FileError {
    read(bytes, channels).expect_err("an invalid file")
}

fn displacement_in(name: &str) -> Channels {
    Channels {
        displacement: Channel {
            name: Some(name.into()),
            unit: None,
            reversed: false,
        },
        ..Channels::default()
    }
}

fn in_group(group: &str) -> Channels {
    Channels {
        group: Some(group.into()),
        ..Channels::default()
    }
}

fn overview_of(bytes: &[u8]) -> Overview {
    let mut file = NamedTempFile::new().expect("a temporary file");
    file.write_all(bytes).expect("a writable file");
    overview(file.path(), &Channels::default()).expect("a file")
}

/// Two groups measure the displacement, and one of these also a force. No group has a name.
fn groups() -> Vec<u8> {
    file(&[
        &[("displacement_m", "m", 10.0), ("force_n", "N", 5.0)],
        &[("displacement_m", "m", 20.0), ("speed", "m/s", 7.0)],
    ])
}

#[test]
fn groups_are_chosen_by_their_number() {
    for (group, first_m) in [("1", 10.0), ("2", 20.0)] {
        let rows = read(&groups(), &in_group(group)).expect("a group");
        assert_eq!(rows[0].displacement_m, first_m, "group {group}");
    }
    for group in ["0", "3", "x"] {
        let error = error_of(&groups(), &in_group(group));
        assert_eq!(remedy(&error), Some(Remedy::NameGroup));
        let expected = format!(
            "run7.mf4: group `{group}` is missing or ambiguous; groups (by number or name): 1, 2"
        );
        assert_eq!(error.to_string(), expected);
    }
    let error = error_of(&groups(), &Channels::default());
    assert_eq!(remedy(&error), Some(Remedy::NameGroup));
    let expected = "run7.mf4: channel displacement_m is in several groups: 1, 2";
    assert_eq!(error.to_string(), expected);
}

/// With several groups, the values decide the group and with it the times. Otherwise the time comes first.
#[test]
fn the_first_missing_channel_is_reported() {
    let channels = Channels {
        time: Channel {
            name: Some("t".into()),
            ..Channel::default()
        },
        ..displacement_in("way")
    };
    for (bytes, name) in [(groups(), "way"), (file(&[&[("x", "m", 1.0)]]), "t")] {
        let error = error_of(&bytes, &channels).to_string();
        let expected = format!("run7.mf4: column {name} is missing; the file has ");
        assert!(error.starts_with(&expected), "{error}");
    }
}

/// Only a force may come from another group: its samples are interpolated.
#[test]
fn channels_of_another_group_are_errors() {
    let channels = Channels {
        time: Channel {
            name: Some("#1".into()),
            ..Channel::default()
        },
        ..in_group("2")
    };
    let error = error_of(&groups(), &channels);
    assert_eq!(remedy(&error), Some(Remedy::NameChannel(Quantity::Time)));
    let expected =
        "run7.mf4: time: channel Time is in group 1, not in group 2; each group has its own times";
    assert!(error.to_string().starts_with(expected), "{error}");
    // A channel with another name is missing, not in another group.
    let source = Box::new(Cursor::new(groups()));
    let channels = Channels {
        force: Channel {
            name: Some("load".into()),
            ..Channel::default()
        },
        ..in_group("2")
    };
    let measurement = Measurement::read(Path::new("run7.mf4"), source, &channels);
    let error = measurement.map(|_| ()).expect_err("no such channel");
    let expected = "run7.mf4: column load is missing; the file has `";
    assert!(error.to_string().starts_with(expected), "{error}");
}

#[test]
fn channels_of_the_same_name_in_one_group_are_counted() {
    let bytes = file(&[&[("displacement_m", "m", 1.0), ("displacement_m", "m", 2.0)]]);
    let error = error_of(&bytes, &Channels::default()).to_string();
    let expected = "run7.mf4: column displacement_m appears 2 times in the header";
    assert!(error.starts_with(expected), "{error}");
}

/// The time is the master channel of its group, whatever the names of the others.
#[test]
fn the_times_are_those_of_the_master_channel() {
    let bytes = file(&[&[("displacement_m", "m", 10.0), ("duration", "s", 7.0)]]);
    let rows = read(&bytes, &Channels::default()).expect("a file");
    let times_s: Vec<f64> = rows.iter().map(|row| row.time_s).collect();
    assert_eq!(times_s, TIMES_S);
    // A channel with the default name is preferred.
    let bytes = file(&[&[("displacement_m", "m", 10.0), ("time_s", "s", 7.0)]]);
    let rows = read(&bytes, &Channels::default()).expect("a file");
    assert_eq!(rows[0].time_s, 7.0);
    // A master channel is never a displacement.
    let bytes = file(&[&[("way", "m", 10.0)]]);
    let error = error_of(&bytes, &Channels::default()).to_string();
    let expected = "run7.mf4: column displacement_m is missing; the file has ";
    assert!(error.starts_with(expected), "{error}");
}

/// Replaces the unit `s` of the master channel, the only one with this unit.
fn with_time_unit(bytes: &[u8], unit: &[u8; 2]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    // A text block: its mark, four reserved bytes, its length, the number of its links and its text.
    let is_second = |block: &[u8]| block.starts_with(b"##TX") && block[24..26] == *b"s\0";
    let blocks: Vec<usize> = bytes
        .windows(32)
        .enumerate()
        .filter(|(_, block)| is_second(block))
        .map(|(at, _)| at)
        .collect();
    let [at] = blocks[..] else {
        panic!("one unit of time, not {blocks:?}");
    };
    bytes[at + 24..at + 26].copy_from_slice(unit);
    bytes
}

/// The standard defines seconds for a master channel without a unit.
#[test]
fn times_have_the_stated_unit_or_else_seconds() {
    let bytes = file(&[&[("displacement_m", "m", 10.0)]]);
    for (unit, last_s) in [(b"s\0", 2.0), (b"\0\0", 2.0), (b"ms", 2e-3)] {
        let rows = read(&with_time_unit(&bytes, unit), &Channels::default()).expect("a file");
        assert_eq!(rows[2].time_s, last_s);
    }
    let bytes = file(&[&[("way", "", 10.0)]]);
    let error = error_of(&bytes, &displacement_in("way"));
    let expected = "run7.mf4: the file does not state the unit of way";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn samples_marked_invalid_are_told_from_those_that_are_not_finite() {
    let mut writer = Mf4Writer::with_start_time_ns(0);
    let group = writer.add_group(&TIMES_S).expect("increasing times");
    group
        .add_channel_with_validity("marked", "m", &[1.0; 3], Some(&[true, false, true]))
        .expect("numbers");
    let infinite = [1.0, f64::INFINITY, 1.0];
    group
        .add_channel("infinite", "m", &infinite)
        .expect("numbers");
    let bytes = bytes(&writer);
    for (name, reason) in [
        ("marked", "the sample is marked invalid"),
        ("infinite", "`inf` is not a finite number"),
    ] {
        let error = error_of(&bytes, &displacement_in(name));
        assert_eq!(remedy(&error), Some(Remedy::SkipInvalid));
        let expected = format!("run7.mf4: row 2: column {name}: {reason}");
        assert_eq!(error.to_string(), expected);
        let skipping = Channels {
            skip_invalid: true,
            ..displacement_in(name)
        };
        assert_eq!(read(&bytes, &skipping).expect("a file").len(), 2);
    }
}

/// The library reports no error if the link to the rows is missing.
#[test]
fn a_file_with_fewer_rows_than_it_declares_is_cut_off() {
    let mut bytes = file(&[&[("displacement_m", "m", 10.0)]]);
    let group = bytes.windows(4).position(|mark| mark == b"##DG");
    // The third link of a data group, behind a header of 24 bytes, leads to the rows.
    let link = group.expect("a data group") + 24 + 2 * 8;
    bytes[link..link + 8].fill(0);
    let error = error_of(&bytes, &Channels::default()).to_string();
    let expected = "run7.mf4: the file declares 3 rows but has 0: it is cut off or damaged";
    assert_eq!(error, expected);
}

/// A conversion of whole numbers or of floats in single precision yields doubles.
#[test]
fn an_overview_states_the_types_of_channels() {
    let linear = || {
        Some(Conversion::Linear {
            offset: 1.0,
            factor: 0.5,
        })
    };
    let mut writer = Mf4Writer::with_start_time_ns(0);
    let group = writer.add_group(&TIMES_S).expect("increasing times");
    let mut add = |name: &str, values: SignalValues, conversion: Option<Conversion>| {
        let added = group.add_channel_typed_with(name, "m", values, None, conversion);
        added.expect("a channel");
    };
    add("single", SignalValues::F32(vec![1.0; 3]), None);
    add("byte", SignalValues::U8(vec![2; 3]), None);
    add("scaled", SignalValues::F32(vec![4.0; 3]), linear());
    let words = ["a", "b", "c"].map(String::from).to_vec();
    add("word", SignalValues::Str(words), None);
    let overview = overview_of(&bytes(&writer));
    let channels = overview.channels.iter();
    let found: Vec<_> = channels
        .map(|channel| (channel.name.as_str(), channel.kind.as_str(), channel.first))
        .collect();
    assert_eq!(
        found[1..],
        [
            ("single", "f32", Some(1.0)),
            ("byte", "u8", Some(2.0)),
            ("scaled", "f64", Some(3.0)),
            ("word", "str", None),
        ]
    );
    assert_eq!(found[0].1, "f64");
    assert_eq!(overview.unended_line, None);
}

#[test]
fn forces_come_from_the_group_with_the_force() {
    let mut file = NamedTempFile::new().expect("a temporary file");
    file.write_all(&groups()).expect("a writable file");
    let history = ForceHistory::open(file.path(), 0.0..=2.0).expect("a file");
    assert_eq!(history.force_n(0.5), 5.5);
}
