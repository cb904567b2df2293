//! For every sensor fault, either the interval contains the true value or a status bit reports that it may not.

use std::fmt::Write;
use std::thread;

use dashpot::document;
use dashpot_core::health::HealthStatus;

use crate::sensors::{CONTAINED, Run, Wrong};
use crate::synthetic::{PRESETS, varied};

const SEEDS: u64 = 10;
/// Time (s) after which each reading must contain the true values or be marked as untrusted.
const SETTLED_S: f64 = 35.0;

/// Faults, each with `true` if the readings must contain the true values or be marked as untrusted. The other faults
/// cannot be distinguished from wear.
const FAULTS: [(&str, Wrong, bool); 34] = [
    ("force + 50 N", Wrong::ForceBias(50.0), true),
    ("force + 200 N", Wrong::ForceBias(200.0), true),
    ("force - 300 N", Wrong::ForceBias(-300.0), true),
    ("force + 1000 N", Wrong::ForceBias(1000.0), true),
    ("displacement + 10 mm", Wrong::DisplacementBias(10e-3), true),
    ("force 1 ms late", Wrong::ForceLag(1), true),
    ("force 5 ms late", Wrong::ForceLag(5), true),
    ("force 10 ms late", Wrong::ForceLag(10), true),
    ("displacement 1 ms late", Wrong::DisplacementLag(1), true),
    ("displacement 5 ms late", Wrong::DisplacementLag(5), true),
    ("displacement 10 ms late", Wrong::DisplacementLag(10), true),
    ("force x 0.5", Wrong::ForceGain(0.5), false),
    ("force x 0.8", Wrong::ForceGain(0.8), false),
    ("force x 0.9", Wrong::ForceGain(0.9), false),
    ("force x 1.1", Wrong::ForceGain(1.1), false),
    ("force x 1.25", Wrong::ForceGain(1.25), false),
    ("displacement x 0.8", Wrong::DisplacementGain(0.8), true),
    ("displacement x 0.9", Wrong::DisplacementGain(0.9), false),
    ("displacement x 1.1", Wrong::DisplacementGain(1.1), false),
    ("displacement x 1.25", Wrong::DisplacementGain(1.25), true),
    ("force drifts by 10 N/s", Wrong::ForceDrift(10.0), true),
    (
        "displacement drifts by 0.1 mm/s",
        Wrong::DisplacementDrift(1e-4),
        true,
    ),
    (
        "force 0 for 0.1 s of every second",
        Wrong::ForceDropout,
        true,
    ),
    (
        "force NaN for 0.1 s of every second",
        Wrong::ForceLost,
        true,
    ),
    (
        "displacement held for 0.1 s of every second",
        Wrong::DisplacementDropout,
        false,
    ),
    ("force stuck at 0", Wrong::ForceStuck(0.0), true),
    ("force stuck at 3000 N", Wrong::ForceStuck(3000.0), true),
    ("displacement stuck", Wrong::DisplacementStuck, true),
    ("force reversed", Wrong::ForceReversed, false),
    ("displacement reversed", Wrong::DisplacementReversed, true),
    ("force dead, noise alone", Wrong::ForceDead, true),
    ("seal friction + 100 N", Wrong::Friction(100.0), true),
    ("seal friction + 400 N", Wrong::Friction(400.0), true),
    ("15 % of air in the oil", Wrong::Air(0.15), true),
];

/// Runs of every preset and seed.
fn runs(wrong: Wrong) -> Vec<Run> {
    let of = |presets: &'static [&'static str]| {
        move || -> Vec<Run> {
            let all = presets.iter();
            all.flat_map(|preset| {
                let healthy = varied(preset, None);
                (0..SEEDS).filter_map(move |seed| wrong.run(&healthy, seed))
            })
            .collect()
        }
    };
    thread::scope(|scope| {
        let second = scope.spawn(of(&PRESETS[2..]));
        let mut all = of(&PRESETS[..2])();
        all.extend(second.join().expect("runs end"));
        all
    })
}

/// The bits at the end, each with the number of runs in which it is set.
fn reported(runs: &[Run]) -> String {
    let mut text = String::new();
    for (name, bit) in HealthStatus::all().iter_names() {
        let count = runs.iter().filter(|run| run.last.status.contains(bit));
        let count = count.count();
        if count > 0 {
            let comma = if text.is_empty() { "" } else { ", " };
            write!(text, "{comma}`{name}` {count}").expect("text grows");
        }
    }
    if text.is_empty() {
        "nothing".into()
    } else {
        text
    }
}

#[test]
fn intervals_contain_the_truth_or_a_bit_says_that_they_may_not() {
    let mut table = String::from(
        "| fault | runs | bits at the end, and in how many runs | trusted at the end | largest error of these, sd | \
         right or in doubt after, s |\n\
         |---|---|---|---|---|---|\n",
    );
    let (mut trusted, mut near) = (0, 0);
    let mut failed = String::new();
    for (name, wrong, must_hold) in FAULTS {
        let runs = runs(wrong);
        let still_trusted: Vec<&Run> = runs.iter().filter(|run| run.last.is_trusted()).collect();
        let largest = still_trusted
            .iter()
            .map(|run| run.error)
            .fold(0.0, f64::max);
        let after = runs.iter().map(|run| run.right_after_s).fold(0.0, f64::max);
        let after_words = if must_hold {
            format!("{after:.1}")
        } else {
            "not assured".into()
        };
        let largest_words = if still_trusted.is_empty() {
            "-".into()
        } else {
            format!("{largest:.1}")
        };
        let row = format!(
            "| {name} | {} | {} | {} | {largest_words} | {after_words} |\n",
            runs.len(),
            reported(&runs),
            still_trusted.len()
        );
        print!("{row}");
        table += &row;
        if !must_hold {
            continue;
        }
        trusted += still_trusted.len();
        near += still_trusted.iter().filter(|run| run.error < 3.0).count();
        if largest > CONTAINED || after > SETTLED_S {
            failed += &row;
        }
    }
    println!("{near} of {trusted} trusted readings within 3 standard deviations");
    assert!(failed.is_empty(), "{failed}");
    assert!(near * 100 >= trusted * 90, "{near} of {trusted}");
    document::compare_part("docs/health.md", "sensors", &table);
}
