//! `dashpot live --recording`: a recording on the page, with its time.

use serde_json::{Value, json};

use crate::common::live::{Live, Viewer};
use crate::common::{dashpot, error_of};

const CASE: [&str; 2] = ["--case", "straight-180"];

/// Records a second of the locomotive and shows it.
fn shown(file: &str) -> (Live, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let seconds = [&CASE[..], &["--duration-s", "1"]].concat();
    match file {
        "run.mf4" => {
            let record = [&seconds[..], &["--record", file]].concat();
            assert!(Live::start(&record, folder.path()).end().status.success());
        }
        _ => {
            let parquet = ["--output", ".", "--parquet"];
            dashpot(
                &[&["vehicle"], &seconds[..], &parquet].concat(),
                folder.path(),
            )
            .success();
        }
    }
    let options = [&CASE[..], &["--recording", file]].concat();
    (Live::start(&options, folder.path()), folder)
}

/// Frames up to this time; returns the number of ticks in them, and the last.
fn frames_to(viewer: &mut Viewer, time_s: f64) -> (u32, f64) {
    let mut ticks = 0;
    loop {
        let frame = viewer.frame();
        ticks += frame.ticks_in_frame;
        if frame.time_s >= time_s - 1e-9 {
            return (ticks, frame.time_s);
        }
    }
}

/// Waits until the recording has played to its end; returns the status then. No frame is left.
fn played(viewer: &mut Viewer, end_s: f64) -> Value {
    frames_to(viewer, end_s);
    viewer.status(|status| status["factor"] == 0.0)
}

#[test]
fn recordings_of_all_formats_are_shown_from_end_to_end() {
    let start_s = 0.001;
    for file in ["run.mf4", "history.csv", "history.parquet"] {
        let (live, _folder) = shown(file);
        let mut viewer = live.connect("");
        let scene = viewer.text("scene");
        assert_eq!(scene["source"], "recording", "{file}");
        assert_eq!(scene["recording"]["name"], file);
        let start = &scene["recording"]["start_s"];
        assert!(
            (start.as_f64().unwrap() - start_s).abs() < 1e-9,
            "{file}: {start}"
        );
        assert_eq!(scene["wheelsets"].as_array().unwrap().len(), 6);
        assert_eq!(scene["dampers"][0]["quantities"], json!([]));
        let end_s = scene["recording"]["end_s"].as_f64().unwrap();
        viewer.text("sought");
        let status = played(&mut viewer, end_s);
        assert_eq!(status["warnings"], json!([]), "{file}");
        // After a jump all frames come at once, and none is lost on a busy machine.
        viewer.tell(json!({"do": "seek", "time_s": end_s}));
        let (ticks, _) = frames_to(&mut viewer, end_s);
        assert_eq!(
            f64::from(ticks),
            ((end_s - start_s) / 1e-3).round() + 1.0,
            "{file}"
        );
        live.signal("-TERM");
        let ended = live.end();
        assert!(ended.status.success());
        assert_eq!(ended.report["viewers"]["came"], 1);
    }
}

#[test]
fn a_recording_is_turned_to_any_time() {
    let (live, _folder) = shown("run.mf4");
    let mut viewer = live.connect("");
    played(&mut viewer, 1.0);
    viewer.tell(json!({"do": "seek", "time_s": 0.5}));
    while viewer.text("sought")["time_s"] != 0.5 {}
    // The frames before the time are those of the whole recording up to it.
    let (ticks, time_s) = frames_to(&mut viewer, 0.5);
    assert_eq!((ticks, time_s), (500, 0.5));
    viewer.tell(json!({"do": "step", "ticks": 3}));
    assert_eq!(frames_to(&mut viewer, 0.5).0, 3);
    for (message, reason) in [
        (json!({"do": "seek", "time_s": 7.0}), "allowed: 0.001 to 1"),
        (json!({"do": "seek"}), "missing field `time_s`"),
        (
            json!({"do": "act", "action": {"action": "speed", "speed_km_h": 100}}),
            "unknown variant `act`",
        ),
        (json!({"do": "run", "factor": -1}), "allowed: 0 to 100"),
    ] {
        let error = viewer.ask(message).unwrap();
        assert!(error.contains(reason), "{error}");
    }
    let mut other = live.connect("?role=viewer");
    other.text("scene");
    assert!(
        other
            .ask(json!({"do": "reset"}))
            .unwrap()
            .contains("only the operator")
    );
}

#[test]
fn what_is_no_recording_of_a_vehicle_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("other.csv"), "time_s,speed\n0,1\n").unwrap();
    let other = |options: &[&str]| {
        let live = ["live", "--recording", "other.csv"];
        error_of(&dashpot(&[&live[..], options].concat(), folder.path()))
    };
    assert!(
        other(&CASE).contains("none of the signals wanted"),
        "{}",
        other(&CASE)
    );
    assert!(other(&[]).contains("no case"), "{}", other(&[]));
    let both = other(&["--case", "straight-180", "--record", "b.mf4"]);
    assert!(
        both.contains("--record") && both.contains("--recording"),
        "{both}"
    );
}

#[test]
fn a_recording_that_lacks_signals_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let text = "time_s,front_lateral_damper_1_force_n\n0,1\n0.001,2\n";
    std::fs::write(folder.path().join("part.csv"), text).unwrap();
    let options = [&CASE[..], &["--recording", "part.csv"]].concat();
    let live = Live::start(&options, folder.path());
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    let status = viewer.text("status");
    let warning = status["warnings"][0].as_str().unwrap();
    assert!(
        warning.contains("of the vehicle's 202 signals"),
        "{warning}"
    );
    let frame = viewer.frame();
    let has = |value: &f32| value.is_finite();
    // Time and force; nothing is made up for the others.
    assert_eq!(
        frame.last.iter().filter(|value| has(value)).count(),
        2,
        "{scene}"
    );
}

/// Values of a signal over the frames are those of the recording.
#[test]
fn the_values_are_those_of_the_file() {
    let (live, folder) = shown("history.csv");
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    let name = "front_lateral_damper_1_force_n";
    let names = scene["signals"].as_array().unwrap();
    let number = names
        .iter()
        .position(|signal: &Value| signal["name"] == name);
    let mut rows = csv::Reader::from_path(folder.path().join("history.csv")).unwrap();
    let column = rows
        .headers()
        .unwrap()
        .iter()
        .position(|other| other == name);
    let forces: Vec<f32> = rows
        .records()
        .map(|row| row.unwrap()[column.unwrap()].parse().unwrap())
        .collect();
    assert_eq!(viewer.ask(json!({"do": "run", "factor": 0})), None);
    viewer.tell(json!({"do": "seek", "time_s": 0.9}));
    while viewer.text("sought")["time_s"] != 0.9 {}
    loop {
        let frame = viewer.frame();
        let at = frame.ticks as usize;
        let of_frame = &forces[at - frame.ticks_in_frame as usize..at];
        assert_eq!(frame.last[number.unwrap()], of_frame[of_frame.len() - 1]);
        let greatest = of_frame.iter().copied().fold(f32::MIN, f32::max);
        assert!(frame.greatest[number.unwrap()] >= greatest);
        if frame.time_s >= 0.9 - 1e-9 {
            return;
        }
    }
}
