//! `dashpot vehicle --realtime`: times of the ticks, and the limits on them.

use std::cell::Cell;
use std::path::Path;
use std::time::Duration;

use assert_cmd::assert::Assert;
use dashpot_files::case::Case;
use dashpot_hil::commands::vehicle::drive::{Driven, Exchange, drive};
use dashpot_realtime::handover::handover;
use dashpot_realtime::pacing::Pacer;
use dashpot_vehicle_run::{Ending, Run, TickRecord, VehicleRunError};
use serde_json::Value;

use crate::budget::SimulatedClock;
use crate::common::{dashpot, error_of, json_of, text_of};

/// Runs the locomotive for 0.3 s, with `options`.
fn vehicle(options: &[&str], folder: &Path) -> Assert {
    let case = ["vehicle", "--case", "straight-180", "--duration-s", "0.3"];
    dashpot(
        &[&case[..], &["--output", ".", "--no-page"], options].concat(),
        folder,
    )
}

/// Names of the keys of an object.
fn keys(object: &Value) -> Vec<&str> {
    let object = object.as_object().unwrap();
    object.keys().map(String::as_str).collect()
}

#[test]
fn the_times_of_the_ticks_are_reported_as_by_budget() {
    let folder = tempfile::tempdir().unwrap();
    let report = json_of(&vehicle(&["--realtime", "--format", "json"], folder.path()));
    let budget = ["budget", "--rate-hz", "1000", "--steps", "20", "--format"];
    let budget = json_of(&dashpot(&[&budget[..], &["json"]].concat(), folder.path()));
    let realtime = &report["realtime"];
    assert_eq!(realtime["first_ticks_ns"].as_array().unwrap().len(), 8);
    let [found, expected] = [realtime, &budget].map(|report| report["spreads"].as_array().unwrap());
    assert_eq!(found.len(), 3);
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(keys(found), keys(expected));
        assert_eq!(found["name"], expected["name"]);
        assert_eq!(found["figures"]["count"], 300);
        let bins = found["histogram"].as_array().unwrap();
        assert_eq!(keys(&bins[0]), keys(&expected["histogram"][0]));
        let counts = bins.iter().map(|bin| bin["count"].as_u64().unwrap());
        assert_eq!(counts.sum::<u64>(), 300);
    }
    // The saved report has them too.
    let saved = std::fs::read_to_string(folder.path().join("indices.json")).unwrap();
    let saved: Value = serde_json::from_str(&saved).unwrap();
    assert_eq!(saved["realtime"], report["realtime"]);
}

#[test]
fn the_histograms_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let text = text_of(&vehicle(&["--realtime"], folder.path()));
    for part in [
        "\nfirst ticks, including clock readings: ",
        "\nwork, per tick: min ",
        "\nlateness, per tick: min ",
        "\nresponse, per tick: min ",
        "  #",
        "-: too few values for this percentile",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// No tick of a locomotive takes only a nanosecond.
#[test]
fn a_run_stops_at_the_first_tick_above_the_limit() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--realtime", "--stop-above-ns", "1", "--format", "json"];
    let ended = vehicle(&options, folder.path()).code(1);
    let message = error_of(&ended);
    assert!(message.contains("stopped: tick 0, 0.000000 s"), "{message}");
    assert!(
        message.contains("allowed by --stop-above-ns: 1.00 ns"),
        "{message}"
    );
    let report = json_of(&ended);
    assert_eq!(report["ticks"], 1);
    assert_eq!(report["ending"]["reason"], "slow_tick");
    assert_eq!(report["ending"]["time_s"], 0.001);
    assert_eq!(report["realtime"]["stopped"]["tick"], 0);
    assert_eq!(report["realtime"]["spreads"][0]["figures"]["count"], 1);
    // The results up to then are kept.
    let history = std::fs::read_to_string(folder.path().join("history.csv")).unwrap();
    assert_eq!(history.lines().count(), 2);
}

/// The load of the machine decides whether a deadline is missed, so the report tells which exit code is right.
#[test]
fn any_missed_deadline_fails_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--realtime", "--fail-on-miss", "--format", "json"];
    let ended = vehicle(&options, folder.path());
    let missed = json_of(&ended)["realtime"]["missed_deadlines"]
        .as_u64()
        .unwrap();
    let ended = ended.code(i32::from(missed > 0));
    let expected = format!("{missed} of 300 deadlines missed; allowed with --fail-on-miss: none");
    assert_eq!(error_of(&ended).contains(&expected), missed > 0);
}

#[test]
fn the_limits_require_real_time() {
    let folder = tempfile::tempdir().unwrap();
    for options in [&["--stop-above-ns", "1000"][..], &["--fail-on-miss"]] {
        let ended = vehicle(options, folder.path()).code(2);
        assert!(
            error_of(&ended).contains("--stop-above-ns and --fail-on-miss require --realtime"),
            "{options:?}"
        );
        assert!(!folder.path().join("history.csv").exists());
    }
    let ended = vehicle(&["--realtime", "--stop-above-ns", "0"], folder.path()).code(2);
    assert!(error_of(&ended).contains("1.."));
}

/// Work of the ticks: 60 us, but 300 us in tick 7 and 2.5 ms in tick 12.
struct Work<'a>(&'a Cell<u64>, u64);

impl Exchange for Work<'_> {
    fn before(&mut self, _: &mut Run) -> Result<(), VehicleRunError> {
        Ok(())
    }
    fn after(&mut self, _: &mut Run, _: impl Fn() -> Duration) -> Option<Ending> {
        let work_ns = match self.1 {
            7 => 300_000,
            12 => 2_500_000,
            _ => 60_000,
        };
        self.0.set(self.0.get() + work_ns);
        self.1 += 1;
        None
    }
}

/// Drives 20 ticks on a simulated clock. Returns the result, the records and the missed deadlines.
fn driven(stop_above_ns: Option<u64>) -> (Driven, u64, u64) {
    let mut case = Case::load("straight-180").unwrap();
    case.duration_s = 0.02;
    let mut run = Run::new(&case).unwrap();
    let (sender, receiver) = handover(vec![TickRecord::new(run.time_s(), run.state()); 32]);
    let now_ns = Cell::new(0);
    let pacer = Pacer::with_clock(1e-3, SimulatedClock(&now_ns)).unwrap();
    let mut pacer = pacer.stopping_above_ns(stop_above_ns);
    let mut work = Work(&now_ns, 0);
    let driven = drive(&mut run, &mut work, Some(&mut pacer), sender, || false).unwrap();
    let mut records = 0;
    while receiver.receive(|_| records += 1) {}
    (driven, records, pacer.report().missed_deadlines)
}

#[test]
fn a_simulated_run_ends_after_its_slow_tick() {
    let (whole, records, missed) = driven(None);
    assert_eq!(whole.ending, Ending::Completed);
    // Tick 12 takes 2.5 ms, so tick 13 ends late too.
    assert_eq!((whole.ticks, records, missed), (20, 20, 2));
    let (stopped, records, missed) = driven(Some(200_000));
    assert_eq!((stopped.ticks, records, missed), (8, 8, 0));
    let Ending::SlowTick {
        tick,
        work_ns,
        limit_ns,
        place,
    } = stopped.ending
    else {
        panic!("{}", stopped.ending)
    };
    assert_eq!((tick, work_ns, limit_ns), (7, 300_000.0, 200_000));
    assert!((place.time_s - 0.008).abs() < 1e-12);
    // A tick exactly at the limit is accepted.
    assert_eq!(driven(Some(300_000)).0.ticks, 13);
}
