//! `dashpot live`: the vehicle as new beside the vehicle, and states to save and load.

use serde_json::{Value, json};

use crate::common::live::{Frame, Live, Viewer};

const DAMPER: &str = "front yaw damper 1";
const FORCE: &str = "front_yaw_damper_1_force_n";

/// Starts a case; returns its page and the number of the damper's force in a frame.
fn live(options: &[&str]) -> (Live, Viewer, usize, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let live = Live::start(options, folder.path());
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    let mut signals = scene["signals"].as_array().unwrap().iter();
    let force = signals.position(|signal| signal["name"] == FORCE).unwrap();
    (live, viewer, force, folder)
}

const STRAIGHT: [&str; 2] = ["--case", "straight-180"];

fn done(viewer: &mut Viewer, message: Value) {
    assert_eq!(viewer.ask(message.clone()), None, "{message}");
}

/// The state of the run. A busy machine may refuse to give it at once.
fn saved(viewer: &mut Viewer) -> Value {
    loop {
        let answer = viewer.answer(json!({"do": "save"}));
        let error = answer["error"].as_str().unwrap_or_default();
        if !error.contains("did not give its state in time") {
            return answer["state"].clone();
        }
    }
}

fn torn_off() -> Value {
    json!({"do": "act", "action": {"action": "fault", "damper": DAMPER, "fault": "torn-off"}})
}

/// Makes ticks of a paused run and returns the frame of a run that ends at `ticks`.
fn step(viewer: &mut Viewer, steps: u32, run: u32, ticks: f64) -> Frame {
    viewer.tell(json!({"do": "step", "ticks": steps}));
    loop {
        let frame = viewer.frame();
        if frame.run == run && frame.ticks == ticks {
            return frame;
        }
    }
}

/// Makes ticks of a paused run and returns the frames of both runs that end at `ticks`.
fn both(viewer: &mut Viewer, steps: u32, ticks: f64) -> [Frame; 2] {
    viewer.tell(json!({"do": "step", "ticks": steps}));
    let mut found: [Option<Frame>; 2] = [None, None];
    while found.iter().any(Option::is_none) {
        let frame = viewer.frame();
        if frame.ticks == ticks {
            let run = frame.run as usize;
            found[run] = Some(frame);
        }
    }
    found.map(Option::unwrap)
}

/// Returns to the start, and stays there.
fn at_start(viewer: &mut Viewer) {
    done(viewer, json!({"do": "run", "factor": 0}));
    done(viewer, json!({"do": "reset"}));
}

#[test]
fn the_vehicle_as_new_runs_beside_the_vehicle() {
    let (_live, mut viewer, force, _folder) = live(&STRAIGHT);
    at_start(&mut viewer);
    step(&mut viewer, 1000, 0, 1000.0);
    done(&mut viewer, torn_off());
    done(&mut viewer, json!({"do": "compare", "on": true}));
    viewer.status(|status| status["is_comparing"] == true);
    let as_new = step(&mut viewer, 1000, 1, 2000.0);
    assert!(as_new.last[force].abs() > 1.0, "{}", as_new.last[force]);
    let worn = step(&mut viewer, 1, 0, 2001.0);
    assert_eq!(worn.last[force], 0.0);

    // A change of speed acts on both vehicles.
    let slower = json!({"action": "speed", "speed_km_h": 20.0});
    done(&mut viewer, json!({"do": "act", "action": slower}));
    let [main, as_new] = both(&mut viewer, 500, 2501.0);
    let distance_m = main.distance_m;
    assert_eq!(distance_m, as_new.distance_m);
    assert!(distance_m < 0.999 * 2.501 * 50.0, "{distance_m}");

    // It goes on after a reset, until it is taken away.
    done(&mut viewer, json!({"do": "reset"}));
    step(&mut viewer, 10, 1, 10.0);
    done(&mut viewer, json!({"do": "compare", "on": false}));
    viewer.status(|status| status["is_comparing"] == false);
    viewer.tell(json!({"do": "step", "ticks": 200}));
    loop {
        let frame = viewer.frame();
        assert!(frame.run == 0 || frame.ticks <= 10.0);
        if frame.ticks == 210.0 {
            break;
        }
    }
}

#[test]
fn a_vehicle_that_is_as_new_equals_the_one_beside_it() {
    let (_live, mut viewer, _, _folder) = live(&STRAIGHT);
    at_start(&mut viewer);
    step(&mut viewer, 700, 0, 700.0);
    done(&mut viewer, json!({"do": "compare", "on": true}));
    let [main, as_new] = both(&mut viewer, 300, 1000.0).map(|frame| frame.last);
    assert_eq!(main, as_new);
}

#[test]
fn a_saved_state_goes_on_with_the_same_bits() {
    let (first, mut viewer, _, _folder) = live(&STRAIGHT);
    at_start(&mut viewer);
    step(&mut viewer, 300, 0, 300.0);
    done(&mut viewer, torn_off());
    let dip = json!({"action": "defect", "kind": "dip", "size": 10.0});
    done(&mut viewer, json!({"do": "act", "action": dip}));
    step(&mut viewer, 100, 0, 400.0);
    let state = saved(&mut viewer);
    let once = step(&mut viewer, 900, 0, 1300.0);
    let load = json!({"do": "load", "state": state});
    done(&mut viewer, load.clone());
    let again = step(&mut viewer, 900, 0, 1300.0);
    assert_eq!(once.last, again.last);
    drop((viewer, first));

    // Another process of the same case, too; another case and a wrong text are refused, and the run goes on.
    let (_live, mut viewer, _, _folder) = live(&STRAIGHT);
    at_start(&mut viewer);
    done(&mut viewer, load.clone());
    assert_eq!(step(&mut viewer, 900, 0, 1300.0).last, once.last);
    let (_live, mut viewer, _, _folder) = live(&["--case", "straight-180", "--speed-km-h", "170"]);
    let error = viewer.ask(load).unwrap();
    assert!(error.contains("of another case"), "{error}");
    let error = viewer.ask(json!({"do": "load", "state": "{}"})).unwrap();
    assert!(error.contains("not a saved state"), "{error}");
    viewer.frame();
}

#[test]
fn a_damper_outside_has_one_state_only() {
    let (_live, mut viewer, _, _folder) = live(&[
        "--case",
        "straight-180",
        "--outside",
        "front yaw damper 1=desk",
        "--actuator",
        "servo",
    ]);
    for message in [
        json!({"do": "compare", "on": true}),
        json!({"do": "save"}),
        json!({"do": "load", "state": "{}"}),
    ] {
        let error = viewer.ask(message).unwrap();
        assert!(error.contains("with a damper outside"), "{error}");
    }
}
