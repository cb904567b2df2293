//! `dashpot link telemetry` and `watch`: the samples of a target.

use std::process::{Child, Stdio};

use serde_json::{Value, json};

use crate::common::{error_of, files_in, text_of};
use crate::link_common::{Rig, TICKS};

fn running() -> Rig {
    let rig = Rig::new();
    rig.run_free();
    rig.text(&["displace", "--displacement-m", "0.002"]);
    rig
}

fn ticks(samples: &[Value]) -> Vec<u64> {
    samples
        .iter()
        .map(|of| of["tick"].as_u64().unwrap())
        .collect()
}

#[test]
fn every_damper_has_its_own_samples_of_the_same_ticks() {
    let rig = running();
    rig.text(&["stop"]);
    // Ticks pass before the two requests of `displace` and of `stop`; the target keeps the last 64.
    let last = u64::from(4 * TICKS);
    let expected: Vec<u64> = (last - 63..=last).collect();
    for place in [1, 0] {
        let reported = rig.json(&["telemetry", "--place", &place.to_string()]);
        let samples = reported["samples"].as_array().unwrap();
        assert_eq!(ticks(samples), expected);
        assert!(samples.iter().all(|of| of["place"] == place));
        let displacement_m = samples[63]["displacement_m"].as_f64().unwrap();
        assert!((displacement_m - 0.002).abs() < 1e-8, "{displacement_m}");
        let overwritten = last - 64;
        assert_eq!(
            reported["places"],
            json!([{"place": place, "taken": 64, "overwritten": overwritten}])
        );
    }
    let text = rig.text(&["telemetry"]);
    assert!(
        text.contains("slot 0: 0 samples fetched; 16 overwritten"),
        "{text}"
    );
    assert!(
        text.contains("slot 2: 64 samples fetched; 16 overwritten"),
        "{text}"
    );
    // A header, the samples of the third damper, and one line per slot.
    assert_eq!(text.lines().count(), 1 + 64 + 3);
}

#[test]
fn samples_go_to_a_file() {
    let rig = running();
    rig.text(&["stop"]);
    let reported = rig.json(&["telemetry", "--output", "samples.csv"]);
    assert_eq!(reported["output"], "samples.csv");
    assert_eq!(reported["samples"], Value::Null);
    let text = rig.read("samples.csv");
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    let header: Vec<&str> = rows.headers().unwrap().iter().collect();
    assert_eq!(
        header,
        ["place", "tick", "displacement_m", "force_n", "status"]
    );
    let rows: Vec<(u8, u32, f32, f32, u16)> = rows.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 3 * 64);
    assert!(rows.iter().any(|(place, _, x, force, _)| {
        *place == 0 && (*x - 0.002).abs() < 1e-8 && *force > 1.0
    }));
    // Samples are returned only once.
    let output = rig.output(&["telemetry", "--output", "-"]);
    assert_eq!(
        output.get_output().stdout,
        b"place,tick,displacement_m,force_n,status\n"
    );
    assert!(String::from_utf8_lossy(&output.get_output().stderr).contains("wrote standard output"));
}

#[test]
fn a_file_that_cannot_be_written_takes_no_sample() {
    let rig = running();
    rig.text(&["stop"]);
    let error = rig.error(&["telemetry", "--output", "none/x.csv"], 1);
    assert!(error.contains("there is no folder none"), "{error}");
    let error = rig.error(&["telemetry", "--place", "3", "--output", "x.csv"], 2);
    assert!(error.contains("allowed: 0 to 2"), "{error}");
    assert!(files_in(rig.folder.path()).is_empty());
    assert_eq!(rig.json(&["telemetry"])["places"][0]["taken"], 64);
}

#[test]
fn samples_are_watched_as_they_come() {
    let rig = running();
    let watch = [
        "watch",
        "--place",
        "0",
        "--samples",
        "200",
        "--format",
        "json",
    ];
    let output = rig.output(&watch).success();
    let text = text_of(&output);
    let samples: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(samples.len(), 200);
    let ticks = ticks(&samples);
    assert!(ticks.is_sorted_by(|a, b| a < b), "{ticks:?}");
    // 20 ticks pass per request, but an answer holds only 8 samples, so some are overwritten before they are fetched.
    let warnings = error_of(&output);
    assert!(warnings.starts_with("warning: slot 0: "), "{warnings}");
    assert!(warnings.contains("overwritten before they were fetched"));
    let text = rig.text(&["watch", "--samples", "9"]);
    assert_eq!(text.lines().count(), 10);
    assert!(text.starts_with(" slot        tick  displacement_m     force_n  status\n"));
    assert!(
        text.lines().last().unwrap().starts_with("    1  "),
        "{text}"
    );
}

#[test]
fn watching_a_stopped_target_ends() {
    let rig = Rig::new();
    let output = rig.output(&["watch"]).code(1);
    let error = error_of(&output);
    assert!(
        error.contains("not free-running, so no more samples will arrive; start it with `run`")
    );
}

fn watch(rig: &Rig) -> Child {
    let mut watch = rig.command(&["watch"]);
    let watch = watch.stdout(Stdio::piped()).stderr(Stdio::null());
    watch.spawn().unwrap()
}

#[test]
fn closing_the_pipe_ends_the_watch() {
    let rig = running();
    let mut watch = watch(&rig);
    drop(watch.stdout.take());
    assert!(watch.wait().unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn an_interruption_ends_the_watch() {
    use std::io::{BufRead, BufReader};
    use std::os::unix::process::ExitStatusExt;
    use std::process::Command;

    const SIGTERM: i32 = 15;
    let rig = running();
    let mut watch = watch(&rig);
    let mut lines = BufReader::new(watch.stdout.take().unwrap()).lines();
    // The command writes the header and each sample as it arrives.
    assert_eq!(lines.by_ref().take(100).map(Result::unwrap).count(), 100);
    let id = watch.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    // Keep reading, so that the command does not block.
    lines.for_each(drop);
    assert_eq!(watch.wait().unwrap().signal(), Some(SIGTERM));
}
