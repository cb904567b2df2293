//! Checks that each fault is detected within 10 s of the ride, with noise of 2 % of each signal's root mean square: if
//! it begins during a run, and from a start that knows only the nominal damper.

use std::fmt::Write;

use dashpot::document;
use dashpot_core::health::HealthStatus;
use dashpot_testbench::health::Noise;

use crate::synthetic::{Fault, PRESETS, errors, estimate, forces, largest, model, ride, varied};

const SEEDS: u64 = 50;
const TEN_SECONDS: usize = 10_000;
const NOISE: f64 = 0.02;

const MAX_FLOW_ERROR: f64 = 0.03;
const MAX_STIFFNESS_ERROR: f64 = 0.10;
const MAX_CLEARANCE_ERROR_M: f64 = 0.15e-3;

/// Errors and status after 10 s with a fault that began after `before` healthy ticks.
fn run(
    preset: &str,
    fault: Fault,
    seed: u64,
    random: bool,
    before: usize,
) -> ([f64; 6], HealthStatus) {
    let healthy = varied(preset, random.then_some(seed));
    let faulty = fault.on(&healthy);
    let x = ride(seed, before + TEN_SECONDS);
    let force = forces(&healthy, &faulty, before, &x);
    let noise = Noise::from_rms(NOISE, &x, &force);
    let model = model(&healthy, &noise);
    let (x, force) = noise.add_to(&x, &force, seed + 7000);
    let reading = estimate(&model, &x, &force);
    (errors(&reading, &faulty, fault), reading.status)
}

/// Runs every seed of a preset and fault.
fn runs(preset: &str, fault: Fault, random: bool, before: usize) -> Vec<([f64; 6], HealthStatus)> {
    let half = |seeds: std::ops::Range<u64>| {
        move || -> Vec<_> {
            seeds
                .map(|seed| run(preset, fault, seed, random, before))
                .collect()
        }
    };
    std::thread::scope(|scope| {
        let second = scope.spawn(half(SEEDS / 2..SEEDS));
        let mut all = half(0..SEEDS / 2)();
        all.extend(second.join().expect("runs end"));
        all
    })
}

/// Checks for every seed that the estimate of the parameter that the fault changes is within its bound, and that only
/// this fault raises an alarm.
fn check(label: &str, fault: Fault, runs: &[([f64; 6], HealthStatus)]) {
    let max = |column: usize| largest(runs.iter().map(|(errors, _)| errors[column]));
    match fault {
        Fault::None => {}
        Fault::Flow => assert!(max(0) < MAX_FLOW_ERROR, "{label}: flow {}", max(0)),
        Fault::Stiffness => assert!(
            max(1) < MAX_STIFFNESS_ERROR,
            "{label}: stiffness {}",
            max(1)
        ),
        Fault::Clearance => assert!(
            max(2) < MAX_CLEARANCE_ERROR_M,
            "{label}: clearance {}",
            max(2)
        ),
    }
    let expected = match fault {
        Fault::None => HealthStatus::empty(),
        Fault::Flow => HealthStatus::FLOW,
        Fault::Stiffness => HealthStatus::STIFFNESS,
        Fault::Clearance => HealthStatus::CLEARANCE,
    };
    let alarms = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
    for (seed, (errors, status)) in runs.iter().enumerate() {
        assert_eq!(
            *status & alarms,
            expected,
            "{label}, seed {seed}: {errors:?}"
        );
    }
}

fn row(label: &str, fault: Fault, runs: &[([f64; 6], HealthStatus)]) -> String {
    let max = |column: usize| largest(runs.iter().map(|(errors, _)| errors[column]));
    let median = |column: usize| {
        let mut all: Vec<f64> = runs
            .iter()
            .map(|(errors, _)| errors[column].abs())
            .collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    let name = match fault {
        Fault::None => "none",
        Fault::Clearance => "2a + 1 mm",
        Fault::Stiffness => "Ke halved",
        Fault::Flow => "discharge + 25 %",
    };
    format!(
        "| {label} | {name} | {:.1}, {:.1} | {:.1}, {:.1} | {:.3}, {:.3} |\n",
        1e2 * median(0),
        1e2 * max(0),
        1e2 * median(1),
        1e2 * max(1),
        1e3 * median(2),
        1e3 * max(2)
    )
}

#[test]
fn a_change_is_known_ten_seconds_later() {
    let mut table = String::from(
        "| damper | fault | flow: median, largest error (%) | Ke (%) | 2a (mm) |\n|---|---|---|---|---|\n",
    );
    for preset in PRESETS {
        for fault in Fault::ALL {
            let runs = runs(preset, fault, false, TEN_SECONDS);
            table += &row(&format!("`{preset}`"), fault, &runs);
            println!("{}", table.lines().last().unwrap_or_default());
            check(preset, fault, &runs);
        }
    }
    document::compare_part("docs/health.md", "change", &table);
}

#[test]
fn a_fault_of_a_random_damper_is_known_ten_seconds_later() {
    let mut failed = String::new();
    for preset in PRESETS {
        for fault in Fault::ALL {
            let runs = runs(preset, fault, true, TEN_SECONDS);
            write!(failed, "{}", row(preset, fault, &runs)).expect("text grows");
            println!("{}", failed.lines().last().unwrap_or_default());
            check(preset, fault, &runs);
        }
    }
}

#[test]
fn a_faulty_damper_is_known_from_ten_seconds_alone() {
    for preset in PRESETS {
        for fault in Fault::ALL {
            let runs = runs(preset, fault, false, 0);
            println!("{}", row(preset, fault, &runs).trim_end());
            check(preset, fault, &runs);
        }
    }
}

/// Reported standard deviations match the actual errors: the ratios of errors to deviations have an RMS near 1.
#[test]
fn reported_uncertainty_matches_the_errors() {
    for preset in PRESETS {
        let runs = runs(preset, Fault::None, false, TEN_SECONDS);
        for column in 3..6 {
            let square = runs
                .iter()
                .map(|(errors, _)| errors[column].powi(2))
                .sum::<f64>();
            let rms = (square / runs.len() as f64).sqrt();
            println!("{preset}: {rms:.2}");
            assert!((0.2..1.5).contains(&rms), "{preset}: {rms}");
        }
    }
}
