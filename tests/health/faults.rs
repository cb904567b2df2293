//! Each fault within 10 s of the ride with noise of 2 % of either signal's root mean square: after a change in a run,
//! and from a start that knows the nominal damper alone.

use std::fmt::Write;

use dashpot::document;
use dashpot_core::health::HealthStatus;
use dashpot_testbench::health::Noise;

use crate::made::{Fault, PRESETS, errors, estimate, forces, largest, model, ride, varied};

const SEEDS: u64 = 50;
const TEN_SECONDS: usize = 10_000;
const NOISE: f64 = 0.02;

const MOST_FLOW: f64 = 0.03;
const MOST_STIFFNESS: f64 = 0.10;
const MOST_CLEARANCE_M: f64 = 0.15e-3;

/// Errors and status after 10 s with a fault that came after `before` ticks without.
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

/// All seeds of a preset and fault.
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

/// The bound of the parameter that the fault changes holds at every seed, and that fault alone is an alarm.
fn check(label: &str, fault: Fault, runs: &[([f64; 6], HealthStatus)]) {
    let most = |place: usize| largest(runs.iter().map(|(errors, _)| errors[place]));
    match fault {
        Fault::None => {}
        Fault::Flow => assert!(most(0) < MOST_FLOW, "{label}: flow {}", most(0)),
        Fault::Stiffness => assert!(most(1) < MOST_STIFFNESS, "{label}: stiffness {}", most(1)),
        Fault::Clearance => assert!(most(2) < MOST_CLEARANCE_M, "{label}: clearance {}", most(2)),
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
    let most = |place: usize| largest(runs.iter().map(|(errors, _)| errors[place]));
    let middle = |place: usize| {
        let mut all: Vec<f64> = runs.iter().map(|(errors, _)| errors[place].abs()).collect();
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
        1e2 * middle(0),
        1e2 * most(0),
        1e2 * middle(1),
        1e2 * most(1),
        1e3 * middle(2),
        1e3 * most(2)
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
fn a_fault_of_a_damper_that_nobody_chose_is_known_ten_seconds_later() {
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

/// Standard deviations told are those found: errors over them have a root mean square near 1.
#[test]
fn what_is_told_to_be_uncertain_is_so() {
    for preset in PRESETS {
        let runs = runs(preset, Fault::None, false, TEN_SECONDS);
        for place in 3..6 {
            let square = runs
                .iter()
                .map(|(errors, _)| errors[place].powi(2))
                .sum::<f64>();
            let rms = (square / runs.len() as f64).sqrt();
            println!("{preset}: {rms:.2}");
            assert!((0.2..1.5).contains(&rms), "{preset}: {rms}");
        }
    }
}
