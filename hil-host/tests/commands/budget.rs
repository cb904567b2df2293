//! Runs of the budget on a simulated clock, and `dashpot budget` as a command.

use std::cell::Cell;
use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_hil::commands::failure::Failure;
use dashpot_realtime::RealtimeError;
use dashpot_realtime::budget::{Length, Run, free, paced};
use dashpot_realtime::pacing::{Clock, Pacer};

use crate::common::{dashpot, error_of, json_of, text_of};

/// Clock that advances with the work of the ticks and with sleeping.
pub struct SimulatedClock<'a>(pub &'a Cell<u64>);

impl Clock for SimulatedClock<'_> {
    fn now_ns(&self) -> u64 {
        self.0.get()
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        self.0.set(deadline_ns);
    }
}

/// Work of tick `number` (ns): 100 ns, but 50 us at tick 7 and 3 ms at tick 12.
fn work_ns(number: u64) -> u64 {
    match number {
        7 => 50_000,
        12 => 3_000_000,
        _ => 100,
    }
}

/// Runs a budget whose ticks take [`work_ns`]; ticks are counted from 0 over all passes.
fn on_simulated_clock(run: impl FnOnce(SimulatedClock<'_>, &mut dyn FnMut()) -> Run) -> Run {
    let now_ns = Cell::new(0);
    let mut number = 0;
    let mut tick = || {
        now_ns.set(now_ns.get() + work_ns(number));
        number += 1;
    };
    run(SimulatedClock(&now_ns), &mut tick)
}

fn free_run(length: Length, stop_above_ns: Option<u64>) -> Run {
    on_simulated_clock(|clock, tick| free(&clock, 30, 1e-3, length, stop_above_ns, tick))
}

fn paced_run(length: Length, stop_above_ns: Option<u64>) -> Run {
    on_simulated_clock(|clock, tick| {
        let pacer = Pacer::with_clock(1e-3, clock).unwrap();
        paced(pacer, length, stop_above_ns, tick)
    })
}

/// Name, number of spans, longest span (ns) and its index for each series.
fn spans(run: &Run) -> Vec<(&str, u64, f64, u64)> {
    let series = run.series.iter();
    series
        .map(|series| {
            let figures = series.spans.figures();
            let place = figures.worst_index * series.ticks_per_span;
            (series.name, figures.count, figures.worst_ns, place)
        })
        .collect()
}

#[test]
fn a_free_run_knows_the_tick_of_its_worst_case() {
    let run = free_run(Length::Ticks(250), None);
    assert_eq!(run.ticks, 250);
    assert_eq!(run.missed_deadlines, None);
    // The 30 ns of the clock are subtracted; three batches of a hundred ticks follow.
    assert_eq!(
        spans(&run),
        [("batched", 3, 99.7, 0), ("single", 250, 2_999_970.0, 12)]
    );
    assert_eq!(
        run.first_ticks_ns[..],
        [100, 100, 100, 100, 100, 100, 100, 50_000]
    );
    assert!(run.verdict(true).is_ok());
}

#[test]
fn a_free_run_lasts_as_long_as_it_is_reported() {
    // Half of the 3.1 ms is for single ticks: tick 12 uses it up. The other half is for batches of 10 us.
    let run = free_run(Length::Nanoseconds(3_100_000), None);
    let counts: Vec<u64> = run.series.iter().map(|s| s.spans.count()).collect();
    assert_eq!(run.ticks, 13);
    assert_eq!(counts, [155, 13]);
}

#[test]
fn a_free_run_stops_at_the_first_tick_above_the_limit() {
    let run = free_run(Length::Ticks(250), Some(40_000));
    let stop = run.stopped.unwrap();
    assert_eq!(
        (stop.tick, stop.work_ns, stop.limit_ns),
        (7, 49_970.0, 40_000)
    );
    assert_eq!(run.ticks, 8);
    assert_eq!(spans(&run), [("single", 8, 49_970.0, 7)]);
    let message = message(run.verdict(false));
    assert_eq!(
        message,
        "stopped: tick 7, 0.007000 s along the motion, took 50.0 us, allowed by --stop-above-ns: 40.0 us"
    );
    // A tick exactly at the limit is accepted.
    assert_eq!(free_run(Length::Ticks(9), Some(49_970)).stopped, None);
}

#[test]
fn a_paced_run_counts_misses_and_fails_on_them_when_asked() {
    let run = paced_run(Length::Ticks(20), None);
    // Tick 12 works for 3 ms, so ticks 12, 13 and 14 end after the next tick is due.
    assert_eq!(run.missed_deadlines, Some(3));
    assert_eq!(
        spans(&run),
        [
            ("work", 20, 3e6, 12),
            ("lateness", 20, 2e6, 13),
            ("response", 20, 3e6, 12)
        ]
    );
    assert!(run.verdict(false).is_ok());
    let message = message(run.verdict(true));
    assert_eq!(
        message,
        "3 of 20 deadlines missed; allowed with --fail-on-miss: none"
    );
    assert!(paced_run(Length::Ticks(12), None).verdict(true).is_ok());
}

#[test]
fn a_paced_run_lasts_as_many_ticks_as_its_time_holds_and_stops_at_a_limit() {
    let run = paced_run(Length::Nanoseconds(30_000_000), None);
    assert_eq!((run.ticks, run.stopped), (30, None));
    let run = paced_run(Length::Nanoseconds(30_000_000), Some(1_000_000));
    assert_eq!(run.ticks, 13);
    let stop = run.stopped.unwrap();
    assert_eq!((stop.tick, stop.work_ns), (12, 3e6));
    assert!((stop.time_s - 0.012).abs() < 1e-12);
}

/// Messages of the command for a run that misses its targets.
fn message(verdict: Result<(), RealtimeError>) -> String {
    Failure::from(verdict.unwrap_err()).to_string()
}

fn budget(arguments: &[&str]) -> Assert {
    dashpot(&[&["budget"], arguments].concat(), Path::new("."))
}

fn json(arguments: &[&str]) -> serde_json::Value {
    let output = budget(&[arguments, &["--format", "json"]].concat());
    json_of(&output)
}

#[test]
fn the_report_has_its_keys() {
    let report = json(&["--steps", "2000"]);
    assert_eq!(report["ticks"], 2000);
    assert!(report["stopped"].is_null() && report["missed_deadlines"].is_null());
    let machine = report["machine"].as_object().unwrap();
    for key in ["processor", "kernel", "governor", "load_average", "date"] {
        assert!(machine.contains_key(key), "{key}");
    }
    for (spread, count) in report["spreads"].as_array().unwrap().iter().zip([20, 2000]) {
        assert_eq!(spread["figures"]["count"], count);
        assert!(spread["figures"]["p99_99_ns"].is_null());
        let worst_tick = spread["worst_tick"].as_u64().unwrap();
        assert!(worst_tick < 2000);
        // The times agree up to rounding, whichever tick was the worst.
        let worst_time_s = spread["worst_time_s"].as_f64().unwrap();
        assert!((worst_time_s - worst_tick as f64 * 1e-3).abs() < 1e-12);
        let bins = spread["histogram"].as_array().unwrap();
        let held: u64 = bins.iter().map(|bin| bin["count"].as_u64().unwrap()).sum();
        assert_eq!(held, count);
    }
    let report = json(&["--rate-hz", "10000", "--steps", "8"]);
    assert_eq!(report["mode"], "paced");
    assert!(report["missed_deadlines"].is_u64());
    assert_eq!(report["first_ticks_ns"].as_array().unwrap().len(), 8);
}

#[test]
fn text_scales_its_units_and_names_what_it_omits() {
    let text = text_of(&budget(&["--steps", "50"]));
    assert!(text.contains("tick 1.00 ms"), "{text}");
    assert!(text.contains("p99 -, p99.9 -, p99.99 -"), "{text}");
    assert!(
        text.contains("-: too few values for this percentile"),
        "{text}"
    );
    assert!(
        text.contains("processor ") && text.contains("governor "),
        "{text}"
    );
}

/// Ten thousand dampers take longer than a nanosecond and longer than a tick of 100 us.
#[test]
fn a_run_that_misses_its_targets_is_reported_and_fails() {
    let crowd = ["--dampers", "10000", "--steps", "2"];
    for (arguments, part, key) in [
        (&["--stop-above-ns", "1"][..], "stopped: tick 0,", "stopped"),
        (
            &["--rate-hz", "10000", "--fail-on-miss"],
            "2 of 2 deadlines missed",
            "missed_deadlines",
        ),
    ] {
        let output = budget(&[&crowd[..], arguments, &["--format", "json"]].concat()).code(1);
        let message = error_of(&output);
        assert!(message.contains(part), "{message}");
        let report = json_of(&output);
        assert!(!report[key].is_null(), "{report}");
    }
}

#[test]
fn wrong_options_say_what_is_allowed() {
    for (arguments, code, part) in [
        (&["--rate-hz", "999"][..], 2, "1000..=10000"),
        (&["--steps", "0"], 2, "1..="),
        (&["--duration-s", "0"], 2, "1..="),
        (
            &["--duration-s", "1", "--steps", "1"],
            2,
            "cannot be used with",
        ),
        (&["--stop-above-ns", "0"], 2, "1.."),
        (&["--fail-on-miss"], 2, "--rate-hz"),
        (
            &["--histogram", "latency.txt"],
            2,
            "--histogram requires --paced or --rate-hz",
        ),
        (&["--fifo", "100"], 2, "1..=99"),
        (
            &["--core", "1000000"],
            2,
            "this process may not use this core; allowed: ",
        ),
    ] {
        let output = budget(arguments).code(code);
        let message = error_of(&output);
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
}

/// Every tick is in one line of each column, or beyond the last line.
#[test]
fn the_histogram_counts_every_tick() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("latency.txt");
    let report = json(&[
        "--paced",
        "--steps",
        "50",
        "--histogram",
        file.to_str().unwrap(),
    ]);
    assert_eq!(
        (&report["mode"], report["step_s"].as_f64()),
        (&"paced".into(), Some(1e-3))
    );
    let text = std::fs::read_to_string(&file).unwrap();
    let mut counted = [0; 3];
    for line in text.lines() {
        let numbers = match line.split_once(": ") {
            Some(("# Histogram Overflows", overflows)) => overflows,
            Some(_) => continue,
            None => line.split_once(' ').unwrap().1,
        };
        let numbers: Vec<u64> = numbers
            .split('\t')
            .filter_map(|number| number.parse().ok())
            .collect();
        for (sum, number) in counted.iter_mut().zip(numbers) {
            *sum += number;
        }
    }
    assert_eq!(counted, [50; 3], "{text}");
}

#[test]
fn a_histogram_on_standard_output_is_alone_there() {
    let output = budget(&["--paced", "--steps", "3", "--histogram", "-"]).success();
    let text = text_of(&output);
    assert!(
        text.starts_with("# Histogram\n# Columns: us work lateness response\n"),
        "{text}"
    );
    assert!(!text.contains("missed deadlines"), "{text}");
}
