//! `dashpot link`: queries, changes and manual control of a simulated target.

use predicates::str::contains;
use serde_json::json;

use crate::common::{dashpot, error_of};
use crate::link_common::{Rig, TICKS};
use crate::pil_common::built;

#[test]
fn hello_reports_who_answers() {
    let rig = Rig::new();
    let greeting = rig.json(&["hello"]);
    let bank = ["reduced-vertical", "in-service", "reduced-lateral"];
    let revisions = bank.map(|name| built(name).revision());
    assert_eq!(
        greeting,
        json!({
            "core_version": env!("CARGO_PKG_VERSION"), "protocol": 3, "dampers": 3, "step_s": 0.001,
            "tick": 0, "running": false, "clock_hz": 1_000_000, "revisions": revisions,
        })
    );
    let text = rig.text(&["hello"]);
    assert!(text.contains("step      1000 us\ntick      0, stepped by the host\n"));
    assert!(
        text.ends_with(&format!("    2  {:#010x}\n", revisions[2])),
        "{text}"
    );
    rig.text(&["run", "--displacement-m", "0"]);
    assert_eq!(rig.json(&["hello"])["running"], true);
    assert!(rig.text(&["hello"]).contains("free-running"));
}

#[test]
fn status_is_reported_by_name_and_cleared() {
    let rig = Rig::new();
    assert_eq!(rig.text(&["status"]).matches("none").count(), 3);
    rig.text(&["run", "--displacement-m", "0"]);
    // The second damper is commanded to move 15 mm within one tick.
    rig.text(&["displace", "--displacement-m", "0,0.015,0"]);
    rig.text(&["stop"]);
    let latched = rig.json(&["status"]);
    let rejected = latched["places"][1]["rejected_inputs"].as_u64().unwrap();
    // Ticks pass before each of the two requests of `stop`.
    assert!((1..=2 * u64::from(TICKS)).contains(&rejected), "{latched}");
    let status = latched["places"][1]["status"].as_array().unwrap();
    assert!(status.contains(&json!("input_limited")), "{latched}");
    assert_eq!(
        latched["places"][0],
        json!({"place": 0, "status": [], "rejected_inputs": 0})
    );
    let cleared = rig.text(&["clear"]);
    assert!(cleared.starts_with("cleared:\n slot  rejected inputs  status\n"));
    assert!(
        cleared.contains(&format!("{rejected}  input limited")),
        "{cleared}"
    );
    assert_eq!(rig.text(&["status"]).matches("0  none").count(), 3);
}

#[test]
fn counters_and_outputs_are_reported() {
    let rig = Rig::new();
    rig.error(&["stop"], 1);
    let counters = rig.json(&["counters"]);
    // Two hellos; the request for the counters is not counted yet.
    assert_eq!(
        (&counters["accepted"], &counters["refused"]),
        (&json!(2), &json!(1))
    );
    assert!(rig.text(&["counters"]).contains("1  requests refused\n"));
    assert_eq!(rig.json(&["outputs"])["outputs_n"], json!([0.0, 0.0, 0.0]));
    rig.text(&["run", "--displacement-m", "0"]);
    rig.text(&["displace", "--displacement-m", "0.005,0,0"]);
    let outputs = rig.json(&["outputs"]);
    assert!(outputs["outputs_n"][0].as_f64().unwrap() > 1.0, "{outputs}");
    assert_eq!(outputs["outputs_n"][1], 0.0);
    assert_eq!(rig.text(&["outputs"]).lines().count(), 4);
}

#[test]
fn the_clearance_changes_live() {
    let rig = Rig::new();
    let before = rig.json(&["hello"]);
    let reported = rig.text(&["set", "--place", "1", "--clearance-m", "0.002"]);
    assert_eq!(reported, "slot 1: clearance 0.002 m\n");
    let after = rig.json(&["hello"]);
    let same = |place: usize| before["revisions"][place] == after["revisions"][place];
    assert_eq!([0, 1, 2].map(same), [true, false, true]);
    let error = rig.error(&["set", "--place", "3", "--clearance-m", "0"], 2);
    assert!(error.contains("--place 3: the target has 3 dampers; allowed: 0 to 2"));
}

#[test]
fn the_tick_runs_stops_and_says_when_it_cannot() {
    let rig = Rig::new();
    let displace = ["displace", "--displacement-m", "0"];
    for action in [&displace[..], &["stop"]] {
        let error = rig.error(action, 1);
        assert!(error.contains("not free-running; run it first"), "{error}");
    }
    let driven = rig.json(&["run", "--displacement-m", "0,1e-3,-2e-3"]);
    assert_eq!(driven["displacements_m"], json!([0.0, 1e-3, -0.002]));
    let error = rig.error(&["run", "--displacement-m", "0"], 1);
    assert!(
        error.contains("the target is free-running; stop"),
        "{error}"
    );
    let driven = rig.json(&["displace", "--displacement-m", "0.01"]);
    assert_eq!(driven["displacements_m"], json!([0.01, 0.01, 0.01]));
    // Two requests of the rejected run, two of this one.
    assert_eq!(driven["tick"], 4 * TICKS);
    let error = rig.error(&["displace", "--displacement-m", "0,1"], 2);
    assert!(
        error.contains(
            "2 values, but the target has 3 slots; allowed: 1 value for all slots or 3 values"
        ),
        "{error}"
    );
    assert_eq!(rig.json(&["stop"]), json!({"running": false}));
}

#[test]
fn a_lost_link_makes_the_outputs_safe_until_run() {
    let rig = Rig::new();
    let reported = rig.text(&["loss-of-link", "--after-ticks", "50", "--output", "zero"]);
    assert_eq!(
        reported,
        "the link is lost after 50 ticks without a displacement; outputs after that: zero\n"
    );
    let run = ["run", "--displacement-m", "0"];
    let displace = ["displace", "--displacement-m", "0.005"];
    rig.text(&run);
    rig.text(&displace);
    let good = rig.json(&["outputs"]);
    assert!(good["outputs_n"][0].as_f64().unwrap() > 1.0, "{good}");
    let safe = rig.json(&["outputs"]);
    assert_eq!(safe["outputs_n"], json!([0.0, 0.0, 0.0]));
    let error = rig.error(&displace, 1);
    assert!(error.contains("lost the link; its outputs stay safe until you run it"));
    rig.text(&run);
    rig.text(&displace);
    rig.text(&["stop"]);
    for output in ["hold", "ramp=7"] {
        let loss = ["loss-of-link", "--after-ticks", "1", "--output", output];
        let reported = rig.json(&loss);
        assert_eq!(reported, json!({"after_ticks": 1, "output": output}));
    }
}

#[test]
fn wrong_use_is_refused_before_the_target_is_contacted() {
    let folder = tempfile::tempdir().unwrap();
    for (action, part) in [
        (&[][..], "Usage"),
        (&["nonsense"], "unrecognized subcommand"),
        (&["hello", "--place", "0"], "unexpected argument"),
        (&["hello", "--format", "xml"], "possible values: text, json"),
        (&["set", "--place", "0"], "--clearance-m"),
        (
            &["set", "--place", "16", "--clearance-m", "0"],
            "16 is not in 0..16",
        ),
        (
            &["set", "--place", "0", "--clearance-m", "0.11"],
            "allowed: 0 to 0.1 m",
        ),
        (
            &["set", "--place", "0", "--clearance-m", "-1e-9"],
            "allowed: 0 to 0.1 m",
        ),
        (
            &["set", "--place", "0", "--clearance-m", "nan"],
            "allowed: 0 to 0.1 m",
        ),
        (&["run"], "--displacement-m"),
        (
            &["run", "--displacement-m", "0,,0"],
            "allowed: a finite number in single precision",
        ),
        (
            &["run", "--displacement-m", "1e39"],
            "allowed: a finite number in single precision",
        ),
        (
            &["loss-of-link", "--after-ticks", "0", "--output", "zero"],
            "0 is not in 1..",
        ),
        (
            &["loss-of-link", "--after-ticks", "9", "--output", "ramp=-1"],
            "allowed: hold, ramp=TICKS, zero",
        ),
        (&["load"], "--damper <NAME|FILE>"),
        (
            &["load", "--damper", "paper", "--image", "x"],
            "cannot be used with",
        ),
        (
            &["load", "--image", "x", "--set", "mount.clearance_m=0"],
            "cannot be used with",
        ),
        (&["load", "--damper", "papre"], "did you mean `paper`?"),
        (&["save"], "--output <FILE>"),
        (&["restore"], "--input <FILE>"),
        (&["watch", "--samples", "0"], "0 is not in 1.."),
    ] {
        // No process listens on this port.
        let line = ["link", "--link", "tcp:localhost:1"];
        let output = dashpot(&[&line[..], action].concat(), folder.path()).code(2);
        let error = error_of(&output);
        assert!(error.contains(part), "{action:?}: {error}");
    }
    dashpot(&["link", "hello"], folder.path())
        .code(2)
        .stderr(contains("--link <LINK>"));
}

#[test]
fn an_absent_target_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    dashpot(
        &["link", "--link", "tcp:localhost:1", "hello"],
        folder.path(),
    )
    .code(1)
    .stderr(contains("tcp:localhost:1: cannot connect"));
}
