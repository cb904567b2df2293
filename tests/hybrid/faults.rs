//! Faults of a rig while the locomotive runs: what the guard does, how soon, and how far the command moves.

use std::fmt::Write;

use dashpot::document;
use dashpot_core::hybrid::{Command, HybridStatus};
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_files::damper;
use dashpot_hybrid::Compensation;
use dashpot_hybrid::rig::{Reading, RigFault};

use crate::DOCUMENT;
use crate::coupled::{Coupled, settings};

const DAMPER: &str = "front lateral damper 1";
/// Ticks of 1 ms before and after the beginning of the fault.
const BEFORE: u32 = 4000;
const AFTER: u32 = 6000;

/// A fault of the table.
enum Fault {
    Rig(RigFault),
    /// The host makes no tick for this time, while the rig goes on.
    Suspended {
        ticks: u32,
    },
}

/// What happened after a fault.
#[derive(Debug)]
struct Outcome {
    status: HybridStatus,
    /// Ticks until the guard acted.
    acted: Option<u32>,
    /// Farthest that the command was from its place at the beginning of the fault until it came to rest, m.
    travel_m: f32,
    fastest_m_per_s: f32,
    is_held: bool,
    /// True if a later tick cleared a bit.
    was_unlatched: bool,
    /// Force for the vehicle in the last tick, N.
    last_force_n: f32,
}

fn case() -> Case {
    let mut options = dashpot_files::case::CaseParts {
        case: Some("straight-180"),
        ..Default::default()
    }
    .options()
    .unwrap()
    .unwrap();
    // A damper with oil, which can get cold.
    options
        .dampers
        .push("front lateral damper=in-service".parse().unwrap());
    let mut case = options.case().unwrap();
    case.duration_s = 11.0;
    case
}

fn run(case: &Case, fault: &Fault) -> Outcome {
    let servo = ActuatorParameters::load("servo").unwrap();
    let limits = settings(&servo);
    let mut coupled = Coupled::new(case, DAMPER, &servo, Compensation::Adaptive, &limits);
    let mut last = None;
    let mut next = |coupled: &mut Coupled| -> Command {
        let command = coupled.tick().expect("the vehicle runs on");
        let rate = last.map_or(0.0, |last_m: f32| (command.command_m - last_m).abs() / 1e-3);
        assert!(
            rate <= limits.guard.velocity_m_per_s * 1.0001,
            "the command moved at {rate} m/s"
        );
        last = Some(command.command_m);
        command
    };
    let mut begun = next(&mut coupled);
    for _ in 1..BEFORE {
        begun = next(&mut coupled);
    }
    assert!(
        (begun.status & HybridStatus::ENDING).is_empty(),
        "{:?}",
        begun.status
    );
    match fault {
        Fault::Rig(fault) => coupled.rig.begin(fault).unwrap(),
        Fault::Suspended { ticks } => {
            for _ in 0..*ticks {
                coupled.measured = coupled.rig.tick(f64::from(begun.command_m));
            }
        }
    }
    let mut found = Outcome {
        status: begun.status,
        acted: None,
        travel_m: 0.0,
        fastest_m_per_s: 0.0,
        is_held: false,
        was_unlatched: false,
        last_force_n: 0.0,
    };
    let mut last_m = begun.command_m;
    for tick in 1..=AFTER {
        let command = next(&mut coupled);
        found.was_unlatched |= !command.status.contains(found.status);
        found.status = command.status;
        found.last_force_n = command.force_n;
        if !(command.status & HybridStatus::ENDING).is_empty() {
            found.acted.get_or_insert(tick);
        }
        if found.acted.is_some() {
            found.travel_m = found
                .travel_m
                .max((command.command_m - begun.command_m).abs());
        }
        found.fastest_m_per_s = found
            .fastest_m_per_s
            .max((command.command_m - last_m).abs() / 1e-3);
        last_m = command.command_m;
    }
    found.is_held = coupled.coupling.transfer().guard().is_held();
    found
}

/// Name of each fault, the fault, and the bits of which one must end the test; none if it must go on.
fn faults(case: &Case) -> Vec<(&'static str, Fault, HybridStatus)> {
    let damper = case.damper(DAMPER).unwrap();
    let changed = |change: &str| {
        let changed = damper::change("changed", damper, &[change.into()]).unwrap();
        Fault::Rig(RigFault::Specimen(Box::new(changed)))
    };
    let rig = Fault::Rig;
    let none = HybridStatus::empty();
    let clearance = format!("mount.clearance_m={}", damper.mount.clearance_m + 3e-3);
    vec![
        (
            "displacement sensor stuck",
            rig(RigFault::Stuck(Reading::Displacement)),
            HybridStatus::IMPLAUSIBLE,
        ),
        (
            "force sensor stuck",
            rig(RigFault::Stuck(Reading::Force)),
            HybridStatus::IMPLAUSIBLE,
        ),
        (
            "sign of the displacement reversed",
            rig(RigFault::Reversed(Reading::Displacement)),
            HybridStatus::TRACKING,
        ),
        (
            "sign of the force reversed",
            rig(RigFault::Reversed(Reading::Force)),
            HybridStatus::SIGN,
        ),
        ("noise tenfold", rig(RigFault::Noisy(10.0)), none),
        ("no readings for 1 tick", rig(RigFault::Silent(1)), none),
        ("no readings for 5 ticks", rig(RigFault::Silent(5)), none),
        (
            "no readings for 20 ticks",
            rig(RigFault::Silent(20)),
            HybridStatus::AGE,
        ),
        (
            "no readings for 500 ticks",
            rig(RigFault::Silent(500)),
            HybridStatus::AGE,
        ),
        (
            "network gone",
            rig(RigFault::Silent(u32::MAX)),
            HybridStatus::AGE,
        ),
        (
            "supply falls to 1 % of its pressure",
            rig(RigFault::Weak(0.01)),
            HybridStatus::TRACKING | HybridStatus::ENERGY,
        ),
        (
            "specimen breaks",
            rig(RigFault::Broken),
            HybridStatus::NO_FORCE,
        ),
        ("3 mm more clearance", changed(&clearance), none),
        ("oil at -30 degC", changed("oil.temperature_c=-30"), none),
        (
            "host suspended for 200 ms",
            Fault::Suspended { ticks: 200 },
            none,
        ),
    ]
}

#[test]
fn every_fault_is_survived_without_a_step_of_the_command() {
    let case = case();
    let mut table = String::from(
        "| fault | guard | after, ticks | command moved, mm | fastest, m/s |\n|---|---|---|---|---|\n",
    );
    for (name, fault, ends) in faults(&case) {
        let found = run(&case, &fault);
        println!("{name}: {found:?}");
        assert!(!found.was_unlatched, "{name}: {found:?}");
        let ending = found.status & HybridStatus::ENDING;
        if ends.is_empty() {
            assert!(ending.is_empty(), "{name}: {found:?}");
        } else {
            assert!(
                ending.intersects(ends) && found.is_held,
                "{name}: {found:?}"
            );
            assert_eq!(found.last_force_n, 0.0, "{name}");
        }
        let seen: Vec<String> = found
            .status
            .iter_names()
            .map(|(name, _)| name.to_lowercase())
            .collect();
        let (after, moved) = match found.acted {
            Some(ticks) => (ticks.to_string(), format!("{:.2}", 1e3 * found.travel_m)),
            None => ("goes on".into(), "-".into()),
        };
        let seen = if seen.is_empty() {
            "-".into()
        } else {
            seen.join(", ")
        };
        let _ = writeln!(
            table,
            "| {name} | {seen} | {after} | {moved} | {:.3} |",
            found.fastest_m_per_s
        );
    }
    document::compare_part(DOCUMENT, "faults", &table);
}
