//! `dashpot live`: page, scene, frames, actions, roles, and the end of a run.

use serde_json::{Value, json};

use crate::common::live::{Live, Viewer};
use crate::common::{dashpot, error_of, json_of, text_of};

const CASE: [&str; 2] = ["--case", "straight-180"];
const DAMPER: &str = "front lateral damper 1";

/// Starts the locomotive with more options.
fn live(options: &[&str]) -> (Live, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    (
        Live::start(&[&CASE, options].concat(), folder.path()),
        folder,
    )
}

/// Number of a signal in a frame.
fn number(scene: &Value, name: &str) -> usize {
    let mut signals = scene["signals"].as_array().unwrap().iter();
    signals.position(|signal| signal["name"] == name).unwrap()
}

fn operator(live: &Live) -> (Viewer, Value) {
    let mut viewer = live.connect("");
    let scene = viewer.text("scene");
    (viewer, scene)
}

#[test]
fn the_page_is_served_with_its_content_policy() {
    let (live, _folder) = live(&[]);
    let get = |line: &str| live.request(&format!("{line} HTTP/1.1\r\nHost: {}", live.address));
    let page = get("GET /");
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n"));
    let policy = page.split("\r\nContent-Security-Policy: ").nth(1).unwrap();
    let policy = policy.split("\r\n").next().unwrap();
    assert!(policy.starts_with("default-src 'none'"), "{policy}");
    assert!(policy.contains("connect-src 'self'"), "{policy}");
    assert!(policy.ends_with("frame-ancestors 'none'"), "{policy}");
    assert!(page.contains("\r\n\r\n<!DOCTYPE html>"));
    assert!(get("HEAD /").ends_with("\r\n\r\n"));
    assert!(get("GET /other").starts_with("HTTP/1.1 404 "));
    assert!(get("POST /").starts_with("HTTP/1.1 405 "));
    assert!(get("GET /live").starts_with("HTTP/1.1 426 "));
    assert!(live.request("nonsense").starts_with("HTTP/1.1 400 "));
}

#[test]
fn a_scene_comes_first_and_every_tick_is_in_a_frame() {
    let (live, _folder) = live(&[]);
    let mut viewer = live.connect("");
    let kinds: Vec<String> = (0..3).map(|_| viewer.kind()).collect();
    assert_eq!(kinds[..2], ["scene", "status"]);
    let (mut viewer, scene) = operator(&live);
    assert_eq!(scene["source"], "machine");
    let signals = scene["signals"].as_array().unwrap().len();
    let (mut before, mut in_a_row, mut lost) = (viewer.frame(), 0, 0);
    while in_a_row < 100 {
        let frame = viewer.frame();
        assert_eq!(frame.signals, signals);
        if frame.ticks != before.ticks + f64::from(frame.ticks_in_frame) {
            // On a busy machine a viewer can lose frames, and its status counts them.
            let mut told = (0..20).map(|_| viewer.text("status")["lost_frames"].as_u64().unwrap());
            let more = told.find(|told| *told > lost);
            lost = more.expect("a tick is in no frame");
            (before, in_a_row) = (viewer.frame(), 0);
            continue;
        }
        in_a_row += 1;
        assert!((frame.time_s - 1e-3 * frame.ticks).abs() < 1e-9);
        for ((last, least), greatest) in frame.last.iter().zip(&frame.least).zip(&frame.greatest) {
            assert!(least <= last && last <= greatest);
        }
        before = frame;
    }
}

#[test]
fn an_action_changes_the_force_of_a_damper() {
    let (live, _folder) = live(&[]);
    let (mut viewer, scene) = operator(&live);
    let force = number(&scene, "front_lateral_damper_1_force_n");
    while viewer.frame().greatest[force] == 0.0 {}
    let fault = json!({"action": "fault", "damper": DAMPER, "fault": "torn-off"});
    assert_eq!(viewer.ask(json!({"do": "act", "action": fault})), None);
    let status = viewer.status(|status| {
        status["dampers"]
            .as_array()
            .unwrap()
            .iter()
            .any(|d| d["changed"] == true)
    });
    assert!(
        status["dampers"]
            .as_array()
            .unwrap()
            .iter()
            .any(|damper| damper["fault"] == "torn-off")
    );
    loop {
        let frame = viewer.frame();
        if frame.least[force] == 0.0 && frame.greatest[force] == 0.0 {
            break;
        }
    }
    // What cannot be done is refused in words, and the run goes on.
    let wrong = json!({"action": "speed", "speed_km_h": 1e4});
    let error = viewer.ask(json!({"do": "act", "action": wrong})).unwrap();
    assert!(error.contains("allowed: 10 to 350"), "{error}");
    let error = viewer.ask(json!({"do": "nonsense"})).unwrap();
    assert!(error.contains("unknown variant `nonsense`"), "{error}");
    let error = viewer.ask(json!({"do": "record", "on": true})).unwrap();
    assert!(error.contains("--record FILE.mf4"), "{error}");
    viewer.frame();
}

#[test]
fn a_run_pauses_steps_and_begins_again() {
    let (live, _folder) = live(&[]);
    let (mut viewer, _) = operator(&live);
    let stepped = viewer.ask(json!({"do": "step", "ticks": 1}));
    assert!(stepped.unwrap().contains("paused"));
    assert_eq!(viewer.ask(json!({"do": "run", "factor": 0})), None);
    viewer.status(|status| status["factor"] == 0.0);
    assert_eq!(viewer.ask(json!({"do": "reset"})), None);
    for (steps, ticks) in [(3, 3.0), (2, 5.0)] {
        // Whoever waits for the answer may miss the frame.
        viewer.tell(json!({"do": "step", "ticks": steps}));
        // Frames of the run before may still be on their way.
        while viewer.frame().ticks != ticks {}
    }
    assert_eq!(viewer.ask(json!({"do": "run", "factor": 0.5})), None);
    while viewer.frame().ticks < 100.0 {}
    assert!(
        viewer
            .ask(json!({"do": "run", "factor": -1}))
            .unwrap()
            .contains("allowed: 0 to 100")
    );
}

#[test]
fn one_operates_and_the_others_watch_but_may_stop() {
    let (live, _folder) = live(&[]);
    let (mut operator, scene) = operator(&live);
    assert_eq!(scene["role"], "operator");
    let mut viewer = live.connect("?role=operator");
    assert_eq!(viewer.text("scene")["role"], "viewer");
    let error = viewer.ask(json!({"do": "run", "factor": 0})).unwrap();
    assert!(error.contains("only the operator acts"), "{error}");
    let error = viewer.ask(json!({"do": "take-over"})).unwrap();
    assert!(error.contains("somebody else operates"), "{error}");
    assert_eq!(viewer.ask(json!({"do": "stop"})), None);
    operator.status(|status| status["factor"] == 0.0);
    assert_eq!(operator.ask(json!({"do": "run", "factor": 1})), None);
    drop(operator);
    viewer.status(|status| status["viewers"] == 1);
    assert_eq!(viewer.ask(json!({"do": "take-over"})), None);
    assert_eq!(viewer.ask(json!({"do": "run", "factor": 0})), None);
}

#[test]
fn wrong_hosts_origins_and_tokens_are_refused() {
    let (live, _folder) = live(&["--token", "only-for-this-test"]);
    assert_eq!(live.token, "only-for-this-test");
    let own = &live.address;
    let port = own.rsplit(':').next().unwrap();
    let with = |host: &str, origin: &str, query: &str| {
        let answer = live.request(&Live::socket_head(host, origin, query));
        answer.lines().next().unwrap().to_owned()
    };
    let token = "?token=only-for-this-test";
    let origin = format!("http://{own}");
    for (host, origin, query) in [
        (own.as_str(), origin.as_str(), ""),
        (own, &origin, "?token=only-for-this-tesT"),
        (own, "http://evil.example", token),
        (own, "null", token),
        (
            &format!("evil.example:{port}"),
            &format!("http://evil.example:{port}"),
            token,
        ),
    ] {
        assert_eq!(
            with(host, origin, query),
            "HTTP/1.1 403 Forbidden",
            "{host} {origin} {query}"
        );
    }
    let page = live.request(&format!("GET / HTTP/1.1\r\nHost: evil.example:{port}"));
    assert!(page.starts_with("HTTP/1.1 403 "), "{page}");
    live.connect(token).text("scene");
}

#[test]
fn an_address_that_others_reach_has_a_token() {
    let folder = tempfile::tempdir().unwrap();
    let live = Live::of(
        &[&["live", "--listen", "0.0.0.0:0"], &CASE[..]].concat(),
        folder.path(),
    );
    assert_eq!(live.token.len(), 32);
    let head = Live::socket_head("bench.example", "http://bench.example", "");
    assert!(live.request(&head).starts_with("HTTP/1.1 403 "));
    live.connect(&format!("?token={}", live.token))
        .text("scene");
}

#[test]
fn a_viewer_who_never_reads_loses_frames_and_nobody_else_notices() {
    let (live, _folder) = live(&[]);
    let _never_reads = live.connect("");
    let mut viewers: Vec<Viewer> = (0..19).map(|_| live.connect("")).collect();
    let reading = viewers.iter_mut().map(|viewer| viewer.text("scene"));
    assert_eq!(reading.count(), 19);
    let watching = std::thread::spawn(move || {
        for _ in 0..1000 {
            for viewer in &mut viewers {
                viewer.frame();
            }
        }
        viewers
    });
    let mut viewers = watching.join().unwrap();
    // Nobody else has frames left to read when the run ends.
    assert_eq!(viewers[0].ask(json!({"do": "stop"})), None);
    for viewer in &mut viewers {
        viewer.status(|status| status["factor"] == 0.0);
    }
    live.signal("-TERM");
    for viewer in &mut viewers {
        let texts = viewer.rest();
        assert!(texts.last().unwrap()["ended"].is_string());
    }
    let ended = live.end();
    assert!(ended.status.success());
    assert_eq!(ended.report["viewers"]["most_at_once"], 20);
    assert!(ended.report["viewers"]["lost_frames"].as_u64().unwrap() > 0);
    assert!(ended.report["ticks"].as_u64().unwrap() > 1000);
}

#[test]
fn a_signal_ends_the_run_with_a_whole_report() {
    let (live, folder) = live(&["--record", "run.mf4"]);
    let (mut viewer, _) = operator(&live);
    viewer.status(|status| status["recorded_ticks"].as_u64().unwrap() > 0);
    live.signal("-TERM");
    let texts = viewer.rest();
    assert!(texts.last().unwrap()["ended"].is_string());
    let ended = live.end();
    assert!(ended.status.success());
    let report = &ended.report;
    assert_eq!(report["ending"]["reason"], "interrupted");
    assert_eq!(report["realtime"]["spreads"].as_array().unwrap().len(), 3);
    assert_eq!(report["viewers"]["came"], 1);
    let [ticks, recorded] =
        [&report["ticks"], &report["recording"]["ticks"]].map(|n| n.as_u64().unwrap());
    let missing = report["unobserved_ticks"].as_u64().unwrap();
    assert_eq!(recorded + missing, ticks);
    let channels = ["channels", "run.mf4", "--format", "json"];
    let channels = json_of(&dashpot(&channels, folder.path()));
    assert_eq!(rows(&channels), recorded);
}

/// Rows of a recording, in the report of `dashpot channels`.
fn rows(channels: &Value) -> u64 {
    channels["channels"][0]["rows"].as_u64().unwrap()
}

#[test]
fn a_duration_ends_the_run() {
    let (live, _folder) = live(&["--duration-s", "0.5"]);
    let ended = live.end();
    assert!(ended.status.success());
    assert_eq!(ended.report["ticks"], 500);
    assert_eq!(ended.report["ending"]["reason"], "completed");
}

#[test]
fn a_killed_process_leaves_a_readable_recording() {
    let (live, folder) = live(&["--record", "run.mf4"]);
    let (mut viewer, scene) = operator(&live);
    let status = viewer.status(|status| status["recorded_ticks"].as_u64().unwrap() > 300);
    live.signal("-KILL");
    live.end();
    let channels = ["channels", "run.mf4", "--format", "json"];
    let channels = json_of(&dashpot(&channels, folder.path()));
    assert!(rows(&channels) >= status["recorded_ticks"].as_u64().unwrap());
    let found = channels["channels"].as_array().unwrap().len();
    assert_eq!(found, scene["signals"].as_array().unwrap().len());
}

#[test]
fn an_emergency_stop_reaches_the_guard_of_a_rig() {
    let rig = [
        "--outside",
        "front yaw damper 1=desk",
        "--actuator",
        "servo",
    ];
    let (live, _folder) = live(&rig);
    let (mut operator, scene) = operator(&live);
    assert_eq!(scene["has_rig"], true);
    let fault = json!({"action": "fault", "damper": "front yaw damper 1", "fault": "torn-off"});
    let error = operator.ask(json!({"do": "act", "action": fault})).unwrap();
    assert!(error.contains("front yaw damper 1 is outside"), "{error}");
    assert!(
        operator
            .ask(json!({"do": "reset"}))
            .unwrap()
            .contains("with a damper outside")
    );
    let mut viewer = live.connect("");
    viewer.frame();
    assert_eq!(viewer.ask(json!({"do": "stop"})), None);
    let texts = viewer.rest();
    let last = texts.iter().rfind(|text| text["type"] == "status").unwrap();
    assert!(
        last["ended"]
            .as_str()
            .unwrap()
            .contains("the end was requested"),
        "{last}"
    );
    let ended = live.end();
    assert!(ended.status.success());
    assert_eq!(ended.report["is_stopped"], true);
    assert_eq!(ended.report["outside"]["rigs"][0]["is_guarded"], true);
}

#[test]
fn the_report_is_also_text() {
    let folder = tempfile::tempdir().unwrap();
    let live = ["live", "--listen", "127.0.0.1:0", "--duration-s", "0.1"];
    let ended = dashpot(&[&live[..], &CASE].concat(), folder.path()).success();
    let text = text_of(&ended);
    assert!(
        text.contains("100 ticks of 1000 us with 0 actions"),
        "{text}"
    );
    assert!(text.contains("viewers: 0 came"), "{text}");
    assert!(text.contains("deadlines missed"), "{text}");
}

#[test]
fn a_page_in_which_the_vehicle_runs_by_itself_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["live", "--case", "curve-r300", "--page", "curve.html"];
    dashpot(&arguments, folder.path()).success();
    let page = std::fs::read_to_string(folder.path().join("curve.html")).unwrap();
    assert!(page.contains(r#""case":"curve-r300""#) && page.contains("worker-src blob:"));
    assert!(page.len() < 4_000_000, "{} bytes", page.len());
    for (more, said) in [
        (&["--step-us", "500"][..], "--step-us with --page"),
        (&["--set", "body.mass=1"], "mass_kg"),
        (
            &["--outside", "front yaw damper 1=desk"],
            "cannot be used with",
        ),
    ] {
        let refused = dashpot(
            &[&arguments[..3], &["--page", "other.html"], more].concat(),
            folder.path(),
        );
        assert!(error_of(&refused.failure()).contains(said), "{more:?}");
        assert!(!folder.path().join("other.html").exists());
    }
}
