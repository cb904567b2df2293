//! `dashpot link save` and `restore`: the states of a bank in a file.

use assert_cmd::assert::OutputAssertExt;
use serde_json::json;

use crate::common::files_in;
use crate::link_common::Rig;

/// A bank that has been moved and stopped.
fn moved() -> Rig {
    let rig = Rig::new();
    rig.text(&["run", "--displacement-m", "0"]);
    rig.text(&["displace", "--displacement-m", "0.003,-1.7e-3,0.015"]);
    rig.text(&["stop"]);
    rig
}

#[test]
fn a_bank_continues_from_its_file_to_the_bit() {
    let rig = moved();
    let reported = rig.text(&["save", "--output", "a.toml"]);
    assert_eq!(reported, "3 states of tick 80 in a.toml\n");
    let saved = rig.read("a.toml");
    let table: toml::Table = saved.parse().unwrap();
    let places = table["places"].as_array().unwrap();
    assert_eq!(places.len(), 3);
    let force = places[0]["force_n"].as_float().unwrap();
    assert!(force > 1.0, "{saved}");
    let status = places[2]["status"].as_array().unwrap();
    assert!(status.contains(&"input_limited".into()), "{saved}");

    rig.text(&["run", "--displacement-m", "0"]);
    rig.text(&["stop"]);
    assert_ne!(rig.json(&["hello"])["tick"], 80);
    let reported = rig.json(&["restore", "--input", "a.toml"]);
    assert_eq!(
        reported,
        json!({"file": "a.toml", "tick": 80, "dampers": 3})
    );
    rig.text(&["save", "--output", "b.toml"]);
    assert_eq!(rig.read("b.toml"), saved);
}

#[test]
fn states_of_other_dampers_are_refused_before_they_are_sent() {
    let rig = moved();
    rig.text(&["save", "--output", "a.toml"]);
    rig.text(&["set", "--place", "1", "--clearance-m", "0.004"]);
    let revision = |place: usize| rig.json(&["hello"])["revisions"][place].as_u64().unwrap();
    let refused = |rig: &Rig| rig.json(&["counters"])["refused"].clone();
    let before = refused(&rig);
    let error = rig.error(&["restore", "--input", "a.toml"], 1);
    assert!(
        error.contains("a.toml: slot 1: state of damper 0x"),
        "{error}"
    );
    assert!(
        error.contains(&format!(
            "the target holds {:#010x}; first load",
            revision(1)
        )),
        "{error}"
    );
    assert!(!error.contains("slot 0") && !error.contains("slot 2"));
    assert_eq!(refused(&rig), before);

    let text = rig.read("a.toml");
    let two = text.rfind("[[places]]").unwrap();
    rig.write("two.toml", &text[..two]);
    let error = rig.error(&["restore", "--input", "two.toml"], 1);
    assert!(
        error.contains("two.toml: 2 states, but the target has 3 slots"),
        "{error}"
    );
}

#[test]
fn a_refusal_of_the_target_is_reported_in_words() {
    let rig = moved();
    rig.text(&["save", "--output", "a.toml"]);
    // No step produces such a force.
    let text = rig.read("a.toml");
    let start = text.find("force_n = ").unwrap();
    let end = start + text[start..].find('\n').unwrap();
    rig.write(
        "b.toml",
        format!("{}force_n = 3e30{}", &text[..start], &text[end..]),
    );
    let error = rig.error(&["restore", "--input", "b.toml"], 1);
    assert!(
        error.contains("or has values that no step produces"),
        "{error}"
    );
    rig.text(&["run", "--displacement-m", "0"]);
    let error = rig.error(&["restore", "--input", "a.toml"], 1);
    assert!(error.contains("is free-running; stop it first"), "{error}");
}

#[test]
fn an_invalid_file_is_reported_with_its_location() {
    let rig = moved();
    rig.text(&["save", "--output", "a.toml"]);
    let text = rig.read("a.toml");
    for (from, to, part) in [
        (
            "tick = 80",
            "tick = -1",
            "x.toml: TOML parse error at line 2",
        ),
        ("tick = 80", "tock = 80", "unknown field `tock`"),
        (
            "revision = \"0x",
            "revision = \"",
            "a revision is 0x and 8 hexadecimal digits",
        ),
        (
            "input_limited",
            "input_limted",
            "unknown variant `input_limted`, expected one of `input_held`",
        ),
        (
            "rejected_inputs = 0\n",
            "",
            "missing field `rejected_inputs`",
        ),
    ] {
        assert!(text.contains(from), "{text}");
        rig.write("x.toml", text.replacen(from, to, 1));
        let error = rig.error(&["restore", "--input", "x.toml"], 1);
        assert!(error.contains(part), "{error}");
    }
    let error = rig.error(&["restore", "--input", "none.toml"], 1);
    assert!(error.contains("none.toml: cannot read"), "{error}");
    let error = rig.error(&["save", "--output", "none/a.toml"], 1);
    assert!(error.contains("there is no folder none"), "{error}");
    assert_eq!(files_in(rig.folder.path()), ["a.toml", "x.toml"]);
}

#[test]
fn standard_streams_carry_states() {
    let rig = moved();
    let saved = rig.output(&["save", "--output", "-"]).success();
    let saved = saved.stderr("3 states of tick 80 in standard output\n");
    rig.write("a.toml", &saved.get_output().stdout);
    let input = std::fs::File::open(rig.folder.path().join("a.toml")).unwrap();
    rig.command(&["restore", "--input", "-"])
        .stdin(input)
        .assert()
        .success();
}
