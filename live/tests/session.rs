//! A live run as a page's worker uses it.

use std::rc::Rc;

use dashpot_live::{Choice, REFERENCE_DIGEST, Session, TablesOf, WheelOnRail, reference_digest};
use serde_json::{Value, json};

/// Bytes before the numbers of a frame.
const HEADER: usize = 48;

fn tables() -> TablesOf {
    Rc::new(|pair: &WheelOnRail| Ok(pair.tables()?))
}

fn session() -> Session {
    Session::new(Choice::of("straight-180"), Vec::new(), tables()).unwrap()
}

/// Sends a message; returns the answer without an error.
fn ask(session: &mut Session, message: &Value) -> Value {
    let answer = session.message(&message.to_string()).pop().unwrap();
    assert!(answer["error"].is_null(), "{message}: {answer}");
    answer
}

fn refused(session: &mut Session, message: &Value) -> String {
    let answer = session.message(&message.to_string()).pop().unwrap();
    answer["error"]
        .as_str()
        .unwrap_or_else(|| panic!("{message}: {answer}"))
        .to_owned()
}

fn act(session: &mut Session, action: Value) {
    ask(session, &json!({"id": 7, "do": "act", "action": action}));
}

fn frame(session: &mut Session, run: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    assert!(session.frame(run, &mut bytes));
    bytes
}

/// Last, least and greatest value of a signal in a frame.
fn signal(session: &mut Session, run: u32, name: &str) -> [f32; 3] {
    let bytes = frame(session, run);
    in_frame(session, &bytes, name)
}

fn in_frame(session: &Session, bytes: &[u8], name: &str) -> [f32; 3] {
    let scene = session.scene();
    let signals = scene["signals"].as_array().unwrap();
    let number = signals
        .iter()
        .position(|signal| signal["name"] == name)
        .unwrap();
    [0, 1, 2].map(|part| {
        let at = HEADER + 4 * (part * signals.len() + number);
        f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    })
}

const YAW: &str = "front yaw damper 1";
const YAW_FORCE: &str = "front_yaw_damper_1_force_n";

#[test]
fn the_reference_run_has_its_digest() {
    let tables = |pair: &WheelOnRail| Ok(pair.tables()?);
    let found = reference_digest(tables).unwrap();
    assert_eq!(
        found, REFERENCE_DIGEST,
        "live/src/reference.sha256 is written by hand when the physics changes"
    );
}

#[test]
fn a_frame_has_the_extremes_of_all_its_ticks() {
    let (mut whole, mut single) = (session(), session());
    whole.advance(400).unwrap();
    frame(&mut whole, 0);
    single.advance(400).unwrap();
    frame(&mut single, 0);
    whole.advance(100).unwrap();
    let mut least = signal(&mut single, 0, YAW_FORCE)[0];
    let mut greatest = least;
    for _ in 0..100 {
        single.advance(1).unwrap();
        let [last, ..] = signal(&mut single, 0, YAW_FORCE);
        (least, greatest) = (least.min(last), greatest.max(last));
    }
    let [_, found_least, found_greatest] = signal(&mut whole, 0, YAW_FORCE);
    assert_eq!([found_least, found_greatest], [least, greatest]);
    assert!(least < greatest);
}

#[test]
fn a_change_of_a_damper_keeps_its_force_continuous() {
    let mut session = session();
    session.advance(1500).unwrap();
    let [before, ..] = signal(&mut session, 0, YAW_FORCE);
    act(
        &mut session,
        json!({"action": "damper", "damper": YAW, "key": "mount.clearance_m", "value": 0.01}),
    );
    session.advance(1).unwrap();
    let [after, ..] = signal(&mut session, 0, YAW_FORCE);
    assert!((after - before).abs() < 200.0, "{before} then {after} N");
    session.advance(1500).unwrap();
    let [_, least, greatest] = signal(&mut session, 0, YAW_FORCE);
    let mut as_new = self::session();
    as_new.advance(1501).unwrap();
    frame(&mut as_new, 0);
    as_new.advance(1500).unwrap();
    let [_, least_new, greatest_new] = signal(&mut as_new, 0, YAW_FORCE);
    assert!(
        greatest - least < 0.8 * (greatest_new - least_new),
        "the clearance takes force away"
    );
}

#[test]
fn the_vehicle_as_new_takes_no_actions_on_dampers() {
    let mut session = session();
    session.advance(500).unwrap();
    act(
        &mut session,
        json!({"action": "fault", "damper": YAW, "fault": "torn-off"}),
    );
    ask(&mut session, &json!({"id": 1, "do": "compare", "on": true}));
    act(
        &mut session,
        json!({"action": "fault", "damper": "front yaw damper 2", "fault": "torn-off"}),
    );
    act(
        &mut session,
        json!({"action": "defect", "kind": "dip", "size": 20}),
    );
    frame(&mut session, 0);
    frame(&mut session, 1);
    session.advance(1500).unwrap();
    let mut even = self::session();
    even.advance(500).unwrap();
    frame(&mut even, 0);
    even.advance(1500).unwrap();
    let [even_frame, worn, new] = [
        frame(&mut even, 0),
        frame(&mut session, 0),
        frame(&mut session, 1),
    ];
    let of = |bytes: &[u8], name: &str| in_frame(&session, bytes, name);
    assert_eq!(of(&worn, "front_yaw_damper_2_force_n")[0], 0.0);
    assert!(of(&new, "front_yaw_damper_2_force_n")[2] > 100.0);
    let least = |bytes: &[u8]| of(bytes, "wheelset_1_left_filtered_load_n")[1];
    for with in [&worn, &new] {
        let (with, without) = (least(with), least(&even_frame));
        assert!(
            with < without - 5e3,
            "both meet the dip: {with} N, {without} N without it"
        );
    }
}

#[test]
fn a_loaded_state_goes_on_with_the_same_bits() {
    let mut one = session();
    one.advance(700).unwrap();
    act(
        &mut one,
        json!({"action": "damper", "damper": YAW, "key": "wear", "value": 0.7}),
    );
    act(&mut one, json!({"action": "speed", "speed_km_h": 120}));
    act(
        &mut one,
        json!({"action": "gust", "force_n": 40000, "duration_s": 2}),
    );
    one.advance(300).unwrap();
    act(
        &mut one,
        json!({"action": "defect", "kind": "twist", "size": 20}),
    );
    one.advance(300).unwrap();
    let state = ask(&mut one, &json!({"id": 1, "do": "save"}))["state"].clone();
    let mut other = session();
    other.advance(123).unwrap();
    ask(&mut other, &json!({"id": 2, "do": "load", "state": state}));
    for session in [&mut one, &mut other] {
        session.advance(900).unwrap();
    }
    // Filtered forces begin anew, so the state itself is compared.
    let [one, other] = [&mut one, &mut other]
        .map(|session| ask(session, &json!({"id": 3, "do": "save"}))["state"].clone());
    assert!(one == other, "the states differ");
}

#[test]
fn a_setting_reproduces_the_run() {
    let mut one = session();
    one.advance(300).unwrap();
    act(
        &mut one,
        json!({"action": "fault", "damper": YAW, "fault": "blocked"}),
    );
    one.advance(200).unwrap();
    act(
        &mut one,
        json!({"action": "defect", "kind": "alignment", "size": 10}),
    );
    act(&mut one, json!({"action": "friction", "factor": 0.5}));
    one.advance(1000).unwrap();
    let setting = one.status()["setting"].clone();
    let mut other = session();
    ask(
        &mut other,
        &json!({"id": 1, "do": "start", "choice": setting["choice"], "actions": setting["actions"]}),
    );
    other.advance(1500).unwrap();
    // The extremes of a frame begin with the frame before.
    let last = |session: &mut Session| frame(session, 0)[HEADER..].to_vec();
    let [one_bytes, other_bytes] = [last(&mut one), last(&mut other)];
    let third = one_bytes.len() / 3;
    assert!(
        one_bytes[..third] == other_bytes[..third],
        "the last values differ"
    );
    assert_eq!(other.status()["setting"]["actions"], setting["actions"]);
}

#[test]
fn what_is_not_allowed_is_told_and_changes_nothing() {
    let mut session = session();
    session.advance(200).unwrap();
    let before = session.status();
    for (action, said) in [
        (
            json!({"action": "damper", "damper": "front yaw dampr 1", "key": "mount.clearance_m", "value": 0.0}),
            "did you mean",
        ),
        (
            json!({"action": "damper", "damper": YAW, "key": "mount.clearance_m", "value": 1.0}),
            "0 to 0.1 m",
        ),
        (
            json!({"action": "damper", "damper": YAW, "key": "oil.temperature_c", "value": 20.0}),
            "oil.temperature_c",
        ),
        (
            json!({"action": "damper", "damper": YAW, "key": "wear", "value": -0.1}),
            "allowed: 0 to 1",
        ),
        (
            json!({"action": "preset", "damper": YAW, "preset": "/etc/passwd"}),
            "no preset",
        ),
        (
            json!({"action": "fault", "damper": YAW, "fault": "gone"}),
            "torn-off",
        ),
        (
            json!({"action": "speed", "speed_km_h": 3.0}),
            "allowed: 10 to 350",
        ),
        (json!({"action": "friction", "factor": -1}), "allowed"),
        (
            json!({"action": "defect", "kind": "dip", "size": 1e9}),
            "allowed: 1 to 20",
        ),
        (
            json!({"action": "defect", "kind": "hole", "size": 1}),
            "alignment",
        ),
        (
            json!({"action": "gust", "force_n": 1e9, "duration_s": 1}),
            "allowed",
        ),
        (json!({"action": "fly"}), "unknown variant"),
    ] {
        let error = refused(
            &mut session,
            &json!({"id": 3, "do": "act", "action": action}),
        );
        assert!(error.contains(said), "{action}: {error}");
    }
    for (message, said) in [
        (
            json!({"id": 1, "do": "start", "choice": {"case": "../straight-180"}}),
            "no shipped case",
        ),
        (
            json!({"id": 1, "do": "start", "choice": {"case": "straight-180", "track": "/etc/passwd"}}),
            "no shipped track",
        ),
        (
            json!({"id": 1, "do": "load", "state": "{}"}),
            "not a saved state",
        ),
        (
            json!({"id": 1, "do": "run", "factor": -1}),
            "allowed: 0 to 100",
        ),
        (
            json!({"id": 1, "do": "recording", "format": "pdf"}),
            "allowed",
        ),
    ] {
        let error = refused(&mut session, &message);
        assert!(error.contains(said), "{message}: {error}");
    }
    assert_eq!(session.status(), before);
}

#[test]
fn the_operators_speed_is_reached_at_a_locomotives_rate() {
    let mut session = session();
    act(&mut session, json!({"action": "speed", "speed_km_h": 170}));
    session.advance(1000).unwrap();
    let speed = |session: &mut Session| {
        let before = session.scene();
        let at = |bytes: Vec<u8>| f64::from_le_bytes(bytes[16..24].try_into().unwrap());
        assert!(before["speed_range_km_h"].is_array());
        let first = at(frame(session, 0));
        session.advance(1).unwrap();
        1000.0 * (at(frame(session, 0)) - first)
    };
    assert!((speed(&mut session) - 49.0).abs() < 0.01);
    session.advance(3000).unwrap();
    assert!((3.6 * speed(&mut session) - 170.0).abs() < 1e-6);
}

#[test]
fn a_worn_damper_is_found_by_its_health() {
    let mut session = session();
    session.advance(3000).unwrap();
    let clearance = |session: &mut Session| {
        let messages = session.message(r#"{"id": 1, "do": "status"}"#);
        let readings = messages[0]["readings"].as_array().unwrap().clone();
        let found = readings
            .into_iter()
            .find(|line| line["damper"] == YAW && line["label"] == "clearance");
        found.unwrap()
    };
    let as_new = clearance(&mut session);
    assert_eq!(as_new["alarm"], false, "{as_new}");
    act(
        &mut session,
        json!({"action": "damper", "damper": YAW, "key": "mount.clearance_m", "value": 0.004}),
    );
    session.advance(8000).unwrap();
    let worn = clearance(&mut session);
    assert_eq!(worn["alarm"], true, "{worn}");
}

#[test]
fn a_recording_has_every_tick() {
    let mut session = session();
    session.advance(10).unwrap();
    ask(&mut session, &json!({"id": 1, "do": "record", "on": true}));
    session.advance(25).unwrap();
    ask(&mut session, &json!({"id": 1, "do": "record", "on": false}));
    session.advance(5).unwrap();
    let file = session
        .message(r#"{"id": 2, "do": "recording", "format": "csv"}"#)
        .remove(0);
    use base64::Engine;
    let bytes = base64::prelude::BASE64_STANDARD
        .decode(file["base64"].as_str().unwrap())
        .unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 26);
    assert!(
        lines[0].starts_with("time_s,distance_m,") && lines[1].starts_with("0.011,"),
        "{}",
        lines[1]
    );
}
