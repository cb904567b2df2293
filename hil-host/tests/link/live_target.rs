//! `dashpot live --link`: a target on the page, driven from there or running free.

use serde_json::{Value, json};

use crate::common::live::Viewer;
use crate::common::{dashpot, error_of};
use crate::link_common::Rig;

/// Greatest displacement and force of a slot over some frames.
fn greatest(viewer: &mut Viewer, slot: usize, frames: usize) -> [f32; 2] {
    let mut found = [0.0_f32; 2];
    for _ in 0..frames {
        let frame = viewer.frame();
        for (number, found) in found.iter_mut().enumerate() {
            *found = found.max(frame.greatest[1 + 3 * slot + number]);
        }
    }
    found
}

#[test]
fn a_target_moves_as_the_page_wants_and_has_the_forces_of_the_model() {
    let rig = Rig::new();
    let live = rig.live(&["--slot-damper", "in-service", "--record", "run.mf4"]);
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    assert_eq!(scene["source"], "target");
    assert_eq!(scene["target"]["dampers"], 3);
    assert_eq!(scene["signals"].as_array().unwrap().len(), 10);
    assert_eq!(scene["dampers"][2]["slug"], "slot_2");
    let motion = json!({"action": "motion", "amplitude_m": 0.01, "frequency_hz": 5.0});
    assert_eq!(viewer.ask(json!({"do": "act", "action": motion})), None);
    let mut moved = 0.0;
    while moved < 0.009 {
        moved = greatest(&mut viewer, 1, 10)[0];
    }
    // A changed damper goes to the target and to the model beside it.
    let [_, before_n] = greatest(&mut viewer, 1, 60);
    let worn = json!({"action": "damper", "damper": "slot 1", "key": "wear", "value": 1.0});
    assert_eq!(viewer.ask(json!({"do": "act", "action": worn})), None);
    viewer.status(|status| status["dampers"][1]["changed"] == true);
    let mut after_n = before_n;
    while after_n > 0.9 * before_n {
        after_n = greatest(&mut viewer, 1, 60)[1];
    }
    for (message, reason) in [
        (
            json!({"action": "motion", "amplitude_m": 1.0, "frequency_hz": 5.0}),
            "allowed: 0 to 0.05",
        ),
        (
            json!({"action": "as-new", "damper": "slot 3"}),
            "allowed: slot 0 to slot 2",
        ),
        (
            json!({"action": "speed", "speed_km_h": 100.0}),
            "a target has dampers only",
        ),
    ] {
        let error = viewer.ask(json!({"do": "act", "action": message})).unwrap();
        assert!(error.contains(reason), "{error}");
    }
    assert_eq!(viewer.ask(json!({"do": "clear-status"})), None);
    let status = viewer.status(|status| status["target"]["round_trip_us"][1].as_f64() > Some(0.0));
    // The first counts answers that a busy machine gave late.
    let counters = status["target"]["counters"].as_array().unwrap();
    assert!(
        counters.len() > 5 && counters[1..].iter().all(|counter| counter["value"] == 0),
        "{counters:?}"
    );
    live.signal("-TERM");
    let ended = live.end();
    assert!(ended.status.success());
    let report = &ended.report;
    assert_eq!(
        (&report["mismatches"], &report["state_mismatches"]),
        (&json!(0), &json!(0))
    );
    assert_eq!(report["recording"]["ticks"], report["ticks"]);
    // What was recorded is a recording like any other: a loop of the first slot.
    let channels = ["channels", "run.mf4", "--format", "json"];
    let channels = crate::common::json_of(&dashpot(&channels, rig.folder.path()));
    assert_eq!(channels["channels"][1]["name"], "slot_0_displacement_m");
}

#[test]
fn the_emergency_stop_ends_the_motion() {
    let rig = Rig::new();
    let live = rig.live(&[]);
    let mut viewer = live.connect("?role=viewer");
    viewer.text("scene");
    let error = viewer.ask(json!({"do": "clear-status"})).unwrap();
    assert!(error.contains("only the operator acts"), "{error}");
    viewer.tell(json!({"do": "stop"}));
    let texts = viewer.rest();
    let last = texts.last().unwrap();
    assert_eq!(last["ended"], "the emergency stop ended the motion");
    let ended = live.end();
    assert_eq!(ended.report["is_stopped"], true);
    assert!(ended.status.success());
}

/// The status of a slot as the page gets it.
fn slot(status: &Value, slot: usize) -> &Value {
    &status["target"]["dampers"][slot]
}

#[test]
fn a_free_target_is_watched_beside_the_model() {
    let rig = Rig::with_ticks(1);
    rig.run_free();
    let bank = ["reduced-vertical", "in-service", "reduced-lateral"];
    let dampers: Vec<&str> = bank
        .iter()
        .flat_map(|name| ["--slot-damper", name])
        .collect();
    let live = rig.live(&dampers);
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    assert_eq!(
        (&scene["motion"], &scene["target"]["running"]),
        (&Value::Null, &json!(true))
    );
    let status = viewer.text("status");
    assert_eq!(status["warnings"], json!([]));
    let moved = json!({"action": "motion", "amplitude_m": 0.01, "frequency_hz": 5.0});
    let error = viewer.ask(json!({"do": "act", "action": moved})).unwrap();
    assert!(error.contains("runs free"), "{error}");
    // Without motion the forces are 0 on both sides; the model is known after half a second of ticks.
    let status = viewer.status(|status| status["target"]["difference_n"][2].is_number());
    assert_eq!(status["target"]["difference_n"], json!([0.0, 0.0, 0.0]));
    assert_eq!(slot(&status, 0)["rejected_inputs"], 0);
    viewer.tell(json!({"do": "stop"}));
    assert_eq!(
        viewer.rest().last().unwrap()["ended"],
        "the emergency stop stopped the target"
    );
    assert!(live.end().status.success());
    assert_eq!(rig.json(&["hello"])["running"], false);
}

#[test]
fn a_free_target_with_other_dampers_is_said_to_have_them() {
    let rig = Rig::with_ticks(1);
    rig.text(&["run", "--displacement-m", "0"]);
    let live = rig.live(&["--slot-damper", "paper"]);
    let mut viewer = live.connect("");
    let warnings = viewer.text("status")["warnings"].clone();
    assert_eq!(warnings.as_array().unwrap().len(), 3, "{warnings}");
    assert!(
        warnings[0]
            .as_str()
            .unwrap()
            .contains("slot 0 runs another damper")
    );
    drop(live);
    let live = rig.live(&[]);
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    assert_eq!(scene["dampers"][0]["quantities"], json!([]));
    let worn = json!({"action": "damper", "damper": "slot 0", "key": "wear", "value": 1.0});
    let error = viewer.ask(json!({"do": "act", "action": worn})).unwrap();
    assert!(error.contains("--slot-damper"), "{error}");
}

#[test]
fn wrong_options_are_refused() {
    let rig = Rig::new();
    let live = |options: &[&str]| {
        let link = ["live", "--link", "tcp:127.0.0.1:1"];
        error_of(&dashpot(&[&link[..], options].concat(), rig.folder.path()))
    };
    for with in [
        &["--case", "straight-180"][..],
        &["--recording", "run.mf4"],
        &["--page", "page.html"],
        &["--damper", "vertical=paper"],
    ] {
        let error = live(with);
        assert!(error.contains("cannot be used with"), "{error}");
    }
    let alone = ["live", "--case", "straight-180", "--slot-damper", "paper"];
    let error = error_of(&dashpot(&alone, rig.folder.path()));
    assert!(error.contains("--link"), "{error}");
}
