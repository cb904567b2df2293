//! MDF4 files with displacement and force in groups of different rates.

use std::io::Cursor;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{
    Channel, Channels, Interpolation, MeasuredSample, Measurement, Quantity, Recording,
};
use falcon_mdf::Mf4Writer;

/// Returns a file with the displacement in group 1 and the force in group 2.
fn file(displacement: &[[f64; 2]], force: &[[f64; 2]], valid: Option<&[bool]>) -> Vec<u8> {
    let mut writer = Mf4Writer::with_start_time_ns(0);
    for (name, unit, rows, valid) in [
        ("displacement_m", "m", displacement, None),
        ("force_n", "N", force, valid),
    ] {
        let [times_s, values] =
            [0, 1].map(|index| rows.iter().map(|row| row[index]).collect::<Vec<_>>());
        let group = writer.add_group(&times_s).expect("increasing times");
        group
            .add_channel_with_validity(name, unit, &values, valid)
            .expect("numbers");
    }
    let mut bytes = Vec::new();
    writer.write(&mut bytes).expect("memory");
    bytes
}

fn open(bytes: &[u8], channels: &Channels) -> Result<Measurement, FileError> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Measurement::read(Path::new("run7.mf4"), source, channels)
}

fn read(bytes: &[u8], channels: &Channels) -> (Vec<[f64; 3]>, Interpolation) {
    let mut measurement = open(bytes, channels).unwrap_or_else(|error| panic!("{error}"));
    let rows = measurement
        .read_all()
        .unwrap_or_else(|error| panic!("{error}"));
    let row = |row: &MeasuredSample| [row.time_s, row.displacement_m, row.force_n];
    let interpolation = measurement.gaps().interpolation;
    (
        rows.iter().map(row).collect(),
        interpolation.expect("two groups"),
    )
}

fn error_of(bytes: &[u8], channels: &Channels) -> String {
    let read = open(bytes, channels).and_then(|mut measurement| measurement.read_all());
    read.expect_err("an invalid file").to_string()
}

/// Displacement at 4 Hz; no force is invented before its first and after its last sample.
#[test]
fn the_force_is_interpolated_to_the_times_of_the_displacement() {
    let displacement: Vec<[f64; 2]> = (0..9)
        .map(|row| [f64::from(row) / 4.0, f64::from(row)])
        .collect();
    let bytes = file(
        &displacement,
        &[[0.5, 10.0], [1.0, 20.0], [1.5, -20.0]],
        None,
    );
    let (rows, interpolation) = read(&bytes, &Channels::default());
    let expected = [
        [0.5, 2.0, 10.0],
        [0.75, 3.0, 15.0],
        [1.0, 4.0, 20.0],
        [1.25, 5.0, 0.0],
        [1.5, 6.0, -20.0],
    ];
    assert_eq!(rows, expected);
    let expected = Interpolation {
        displacement_group: 1,
        force_group: 2,
        outside: 4,
        left_out: 0,
        longest_interval_s: Some(0.5),
    };
    assert_eq!(interpolation, expected);
    // A motion alone has all its rows.
    let source = Box::new(Cursor::new(bytes));
    let mut motion = Recording::read(Path::new("run7.mf4"), source).expect("a file");
    assert_eq!(motion.read_all().expect("rows").len(), 9);
    assert_eq!(motion.gaps().interpolation, None);
}

#[test]
fn units_and_signs_apply_to_both_groups() {
    let bytes = file(
        &[[1000.0, 1.0], [2000.0, 2.0]],
        &[[0.0, 1.0], [3000.0, 4.0]],
        None,
    );
    let mut channels = Channels::default();
    channels.time.unit = Quantity::Time.unit("ms");
    channels.force = Channel {
        name: Some("#4".into()),
        unit: Quantity::Force.unit("kN"),
        reversed: true,
    };
    let (rows, _) = read(&bytes, &channels);
    assert_eq!(rows, [[1.0, 1.0, -2000.0], [2.0, 2.0, -3000.0]]);
}

#[test]
fn groups_without_common_times_are_refused() {
    let bytes = file(&[[0.0, 1.0], [1.0, 2.0]], &[[5.0, 1.0], [6.0, 4.0]], None);
    let expected = "run7.mf4: no time of the displacement (group 1: 0 s to 1 s) is within the times of the force \
                    (group 2: 5 s to 6 s), so no force can be interpolated";
    assert_eq!(error_of(&bytes, &Channels::default()), expected);
}

#[test]
fn missing_samples_of_the_force_are_errors_or_omitted() {
    let displacement = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    let force = [[0.0, 0.0], [1.0, 99.0], [2.0, 20.0]];
    let bytes = file(&displacement, &force, Some(&[true, false, true]));
    let expected = "run7.mf4: row 2: column force_n: the sample is marked invalid";
    assert_eq!(error_of(&bytes, &Channels::default()), expected);
    let channels = Channels {
        skip_invalid: true,
        ..Channels::default()
    };
    let (rows, interpolation) = read(&bytes, &channels);
    assert_eq!(rows[1], [1.0, 1.0, 10.0]);
    assert_eq!(
        (interpolation.left_out, interpolation.longest_interval_s),
        (1, Some(2.0))
    );
}
