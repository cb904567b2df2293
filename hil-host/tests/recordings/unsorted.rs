//! Unsorted MDF4: several groups and variable-length texts in one stream, as loggers write them.

use std::path::Path;

use dashpot_recording::{Channel, Channels};

use crate::common::{dashpot, json_of};
use crate::forms::{rows, samples};

#[test]
fn channels_of_all_groups_are_listed() {
    let ended = dashpot(
        &["channels", "unsorted.mf4", "--format", "json"],
        &samples(),
    );
    let report = json_of(&ended.success());
    let channels = report["channels"].as_array().unwrap();
    let listed: Vec<_> = channels
        .iter()
        .map(|c| {
            (
                c["name"].as_str().unwrap(),
                c["group"].as_u64().unwrap(),
                c["rows"].as_u64().unwrap(),
            )
        })
        .collect();
    assert_eq!(
        listed,
        [
            ("time", 1, 60),
            ("Weg", 1, 60),
            ("Kraft", 1, 60),
            ("Notiz", 1, 60),
            ("time", 2, 6),
            ("Temperatur", 2, 6)
        ]
    );
    let temperature = &channels[5];
    assert_eq!(
        (&temperature["min"], &temperature["max"]),
        (&20.0.into(), &26.25.into())
    );
    // Texts have no range.
    assert_eq!(channels[3]["min"], serde_json::Value::Null);
}

/// Returns the force in `file`.
fn replayed(file: &str, folder: &Path) -> Vec<u8> {
    let input = samples().join(file);
    let replay = ["replay", "--input", input.to_str().unwrap()];
    let channels = ["--group", "Messung", "--displacement", "Weg"];
    let output = ["--output", "force.csv"];
    dashpot(&[&replay[..], &channels, &output].concat(), folder).success();
    std::fs::read(folder.join("force.csv")).unwrap()
}

#[test]
fn a_replay_is_that_of_the_sorted_file() {
    let folder = tempfile::tempdir().unwrap();
    let force = replayed("unsorted.mf4", folder.path());
    assert_eq!(force, replayed("plain.mf4", folder.path()));
}

#[test]
fn texts_are_not_signals() {
    let channels = Channels {
        displacement: Channel {
            name: Some("Weg".into()),
            ..Channel::default()
        },
        force: Channel {
            name: Some("Notiz".into()),
            ..Channel::default()
        },
        ..Channels::default()
    };
    let error = rows(&samples().join("unsorted.mf4"), &channels).expect_err("texts");
    let error = error.to_string();
    assert!(
        error.contains("force: channel Notiz contains"),
        "the type is not reported: {error}"
    );
}

/// The library drops records that are divided between data blocks, so it gets blocks that do not divide them.
#[test]
fn records_divided_between_blocks_are_joined() {
    let folder = tempfile::tempdir().unwrap();
    let force = replayed("unsorted_parts.mf4", folder.path());
    assert_eq!(force, replayed("plain.mf4", folder.path()));
}
