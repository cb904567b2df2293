//! One damper of the locomotive on a servo-hydraulic rig: straight track and a curve of 600 m.

use std::fmt::Write;

use dashpot::document;
use dashpot_core::hybrid::HybridStatus;
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_hybrid::Compensation;
use dashpot_study::verification::{Effect, IndexEffect};

use crate::DOCUMENT;
use crate::coupled::{Coupled, settings, unguarded};

const DAMPERS: [&str; 3] = [
    "front yaw damper 1",
    "front lateral damper 1",
    "front vertical damper 1",
];

fn force_error(effect: &Effect) -> f64 {
    effect.dampers[0].difference_rms_n / effect.dampers[0].force_rms_n
}

/// Mean or root mean square with the largest change among those that `is_wanted`.
fn largest(effect: &Effect, is_wanted: fn(&str) -> bool) -> &IndexEffect {
    let of_kind = |index: &&IndexEffect| !index.is_extreme && is_wanted(&index.index);
    let wanted = effect.indices.iter().filter(of_kind);
    wanted
        .max_by(|a, b| a.relative.total_cmp(&b.relative))
        .unwrap()
}

/// Sperling's index and the comfort index of a point on the floor.
fn is_ride(index: &str) -> bool {
    index.contains("floor")
}

#[test]
fn a_compensated_rig_gives_the_indices_of_the_ideal_coupling() {
    let servo = ActuatorParameters::load("servo").unwrap();
    let mut table = String::from(
        "| case | damper | compensation | force error, % | largest change of an index, % | of a ride index, % |\n\
         |---|---|---|---|---|---|\n",
    );
    for name in ["straight-180", "curve-r600"] {
        let case = Case::load(name).unwrap();
        for damper in DAMPERS {
            for (label, compensation) in [
                ("none", Compensation::None),
                ("inverse", Compensation::Inverse),
                ("adaptive", Compensation::Adaptive),
            ] {
                let is_adaptive = compensation == Compensation::Adaptive;
                let limits = if is_adaptive {
                    settings(&servo)
                } else {
                    unguarded(&servo)
                };
                let coupled = Coupled::new(&case, damper, &servo, compensation, &limits);
                let (effect, status) = coupled.finish();
                let (error, all) = (force_error(&effect), largest(&effect, |_| true));
                let ride = largest(&effect, is_ride);
                if is_adaptive {
                    assert!(
                        (status & HybridStatus::ENDING).is_empty(),
                        "{name}, {damper}: {status:?}"
                    );
                    assert!(error <= 0.03, "{name}, {damper}: {error}");
                    assert!(all.relative <= 0.01, "{name}, {damper}: {all:?}");
                    let is_whole = (effect.duration_s - case.duration_s).abs() < 1e-6;
                    assert!(is_whole, "{name}, {damper}: {} s", effect.duration_s);
                } else if compensation == Compensation::None {
                    assert!(error > 0.2, "{name}, {damper}: {error}");
                }
                let _ = writeln!(
                    table,
                    "| {name} | {damper} | {label} | {:.1} | {:.2}, {} | {:.2} |",
                    1e2 * error,
                    1e2 * all.relative,
                    all.index,
                    1e2 * ride.relative
                );
            }
        }
    }
    document::compare_part(DOCUMENT, "locomotive", &table);
}
