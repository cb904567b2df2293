//! Times with dates (ISO 8601) in text.

use std::io::Cursor;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{Channel, Channels, Quantity, Recording};

fn times_with(text: &str, channels: &Channels) -> Result<Vec<f64>, FileError> {
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    let rows = Recording::read_with(Path::new("run7.csv"), source, channels)
        .and_then(|mut recording| recording.read_all())?;
    Ok(rows.iter().map(|row| row.time_s).collect())
}

fn times(text: &str) -> Vec<f64> {
    times_with(text, &Channels::default()).unwrap_or_else(|error| panic!("{text:?}: {error}"))
}

fn error_of(text: &str) -> String {
    let read = times_with(text, &Channels::default());
    read.expect_err("an invalid text").to_string()
}

/// A double has too few digits for a date with nanoseconds: the difference must be taken before.
#[test]
fn times_count_from_the_first_row_to_the_nanosecond() {
    let text = "time,displacement_m\n2026-11-28T23:59:59.999999999Z,0\n2026-11-29T00:00:00.000000001Z,1\n\
                2026-11-29T00:00:01.123456789Z,2\n";
    assert_eq!(times(text), [0.0, 2e-9, 1.12345679]);
    // The header may state another unit, and a row of units may follow it.
    for head in [
        "time_ms,displacement_m\n",
        "time,displacement_m\n-,m\n",
        "time [ms],displacement_m\n",
    ] {
        let rows = "2026-11-28 21:52:03,0\n2026-11-28 21:52:03.5,1\n";
        assert_eq!(times(&format!("{head}{rows}")), [0.0, 0.5], "{head}");
    }
}

#[test]
fn decimal_commas_and_offsets_are_read() {
    let text =
        "time;displacement_m\n2026-10-25T02:59:59,5+02:00;0,5\n2026-10-25T02:00:00,5+01:00;1,5\n";
    assert_eq!(times(text), [0.0, 1.0]);
    let text = "2026-11-28 21:52:03\t0\n2026-11-28 21:52:04\t1\n";
    let channel = |number: &str| Channel {
        name: Some(number.into()),
        ..Channel::default()
    };
    let mut channels = Channels {
        time: channel("1"),
        displacement: channel("2"),
        ..Channels::default()
    };
    channels.displacement.unit = Quantity::Displacement.unit("m");
    // A chosen unit would change a time with its date: it does not apply.
    channels.time.unit = Quantity::Time.unit("ms");
    assert_eq!(times_with(text, &channels).expect("a text"), [0.0, 1.0]);
}

#[test]
fn other_cells_in_a_column_of_times_are_errors() {
    let text = "time,displacement_m\n2026-11-28T21:52:03Z,0\n";
    for cell in ["2026-11-28T21:52:04", "2026-11-28T21:52:61Z", "4.5", "x"] {
        let error = error_of(&format!("{text}{cell},1\n"));
        let expected =
            format!("run7.csv:3: column time: `{cell}` is not a time such as 2026-11-28T");
        assert!(error.starts_with(&expected), "{error}");
    }
    let error = error_of(&format!("{text},1\n"));
    assert!(
        error.starts_with("run7.csv:3: column time: `` is not a finite number"),
        "{error}"
    );
    let error = error_of(&format!("{text}2026-11-28T21:52:03Z,1\n"));
    assert!(error.contains("time 0 s does not increase"), "{error}");
}
