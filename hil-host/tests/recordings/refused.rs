//! Requests for channels that a file does not contain, and ambiguous requests.

use dashpot_recording::{Channel, Channels};

use crate::forms::{rows, samples};

fn named(displacement: &str, force: &str) -> Channels {
    let channel = |name: &str| Channel {
        name: Some(name.to_owned()),
        ..Channel::default()
    };
    Channels {
        displacement: channel(displacement),
        force: channel(force),
        ..Channels::default()
    }
}

#[test]
fn an_ambiguous_group_must_be_chosen() {
    let mut no_group = named("Weg", "Kraft");
    no_group.group = Some("schnell".into());
    let mut two_groups = named("3", "6");
    two_groups.time.name = Some("#4".into());
    let cases = [
        (
            "groups.mf4",
            named("Weg", "Temperatur"),
            "the file states the unknown unit `degC` for Temperatur; known units of force:",
        ),
        (
            "groups.mf4",
            no_group,
            "group `schnell` is missing or ambiguous; groups (by number or name): 1 `langsam`, 2 `Messung`",
        ),
        (
            "groups.mf4",
            two_groups,
            "displacement: channel Weg is in group 1 (langsam), not in group 2 (Messung)",
        ),
        (
            "plain.mf4",
            named("Weg", "force"),
            "column force is missing; the file has `time`, `Weg`, `Kraft`",
        ),
        (
            "units.parquet",
            named("x", "F"),
            "column time_s is missing; the file has `t`, `x`, `F`",
        ),
    ];
    for (file, channels, expected) in cases {
        let error = rows(&samples().join(file), &channels)
            .expect_err("refused")
            .to_string();
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
    }
    let mut only_displacement = named("Weg", "Kraft");
    only_displacement.force = only_displacement.displacement.clone();
    let path = samples().join("groups.mf4");
    let error = rows(&path, &only_displacement)
        .expect_err("several")
        .to_string();
    let expected = "channel Weg is in several groups: 1 (langsam), 2 (Messung)";
    assert!(error.contains(expected), "{error}");
}
