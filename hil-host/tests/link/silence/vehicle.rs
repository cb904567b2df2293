//! A vehicle around a target that falls silent: every tick on a simulated clock.

use std::time::Duration;

use dashpot_files::case::Case;
use dashpot_hil::commands::vehicle::drive::{Driven, drive};
use dashpot_hil::commands::vehicle::outside::line::{Line, Waits};
use dashpot_hil::commands::vehicle::outside::lines::Lines;
use dashpot_host_link::RetryLimits;
use dashpot_realtime::handover::handover;
use dashpot_realtime::pacing::{Clock, Pacer, PacingReport};
use dashpot_vehicle_run::{Ending, LostDamper, Run, TickRecord, VehicleTick, outside_index};

use super::{FallsSilent, Silent, SimulatedClock};

const LATERAL: &str = "front lateral damper 1";
const VERTICAL: &str = "front vertical damper 2";
const STEP: Duration = Duration::from_millis(1);
/// The irregularity of the track begins under the vehicle.
const START_M: f64 = 10.0;
/// Limit for ticks in a row without an answer.
const HOLD_TICKS: u64 = 40;

/// Results of a run.
struct Ran {
    driven: Driven,
    pacing: Option<PacingReport>,
    /// Displacement (m) and force (N) of the lateral damper after each tick.
    records: Vec<(f64, f64)>,
    lines: Lines,
    took: Duration,
}

/// Runs the locomotive for 0.2 s, in real time on a simulated clock if `is_paced`. The lateral damper is on a target
/// that is silent during `ticks`, the vertical one on another target that always answers.
fn run(ticks: std::ops::Range<u32>, is_paced: bool) -> Ran {
    let mut case = Case::load("straight-180").unwrap();
    case.duration_s = 0.2;
    case.start_m = START_M;
    let mut run = Run::new(&case).unwrap();
    let clock = SimulatedClock::default();
    let waits = Waits {
        retry_limits: RetryLimits::default(),
        hold: is_paced.then_some((STEP, HOLD_TICKS)),
    };
    let line = |name: &str, damper: &str, ticks| {
        let damper = outside_index(&case, damper, &[]).unwrap();
        let link = Box::new(FallsSilent::new(Silent::Deaf, ticks, &clock));
        Line::start(name, link, vec![damper], &case, waits).unwrap()
    };
    let mut lines = Lines::new(vec![
        line("rig", LATERAL, ticks),
        line("desk", VERTICAL, 0..0),
    ]);
    let lateral = outside_index(&case, LATERAL, &[]).unwrap();
    for damper in [lateral, outside_index(&case, VERTICAL, &[]).unwrap()] {
        let set = run.state_mut().set_outside_force_n(damper, Some(0.0));
        set.unwrap();
    }
    let (sender, receiver) = handover(vec![TickRecord::new(run.time_s(), run.state()); 256]);
    let mut pacer = is_paced.then(|| Pacer::with_clock(case.step_s, clock.clone()).unwrap());
    let begun_ns = clock.now_ns();
    let driven = drive(&mut run, &mut lines, pacer.as_mut(), sender, || false).unwrap();
    let mut records = Vec::new();
    while receiver.receive(|record| {
        records.push((
            record.damper_displacements_m()[lateral],
            record.damper_forces_n()[lateral],
        ));
    }) {}
    Ran {
        driven,
        pacing: pacer.map(Pacer::into_report),
        records,
        lines,
        took: Duration::from_nanos(clock.now_ns() - begun_ns),
    }
}

/// Forces of the lateral damper at the displacements of the records, from rest.
fn forces_n(records: &[(f64, f64)]) -> Vec<f64> {
    let case = Case::load("straight-180").unwrap();
    let damper = case.damper(LATERAL).unwrap();
    let damper = damper.build::<f32>(1e-3).unwrap();
    let mut state = damper.at_rest(0.0);
    let forces = records.iter();
    forces
        .map(|(x, _)| f64::from(damper.step(&mut state, *x as f32)))
        .collect()
}

/// The target does not answer the displacements of 0.100 s to 0.119 s.
#[test]
fn the_vehicle_goes_on_with_the_last_force_and_then_with_the_right_one() {
    let ran = run(100..120, true);
    assert_eq!(ran.driven.ending, Ending::Completed);
    assert_eq!((ran.driven.ticks, ran.records.len()), (200, 200));
    let expected_n = forces_n(&ran.records);
    for (index, (_, force_n)) in ran.records.iter().enumerate().skip(1) {
        // The force of a tick answers the displacement of the tick before it: index 99 is that of 0.100 s.
        let answered = index - 1;
        let source = if (99..119).contains(&answered) {
            98
        } else {
            answered
        };
        assert_eq!(*force_n, expected_n[source], "index {index}");
    }
    assert!(expected_n[98].abs() > 10.0, "{}", expected_n[98]);
    let [silent, other] = ran.lines.lines() else {
        panic!()
    };
    let found = silent.silence();
    assert_eq!(found.missing.missing_answers, 20);
    assert_eq!(found.missing.most_missing_in_a_row, 20);
    let first_s = found.first_missing_s.unwrap();
    assert!((first_s - 0.1).abs() < 1e-9, "{first_s}");
    assert_eq!(other.silence().missing.missing_answers, 0);
    // The silent ticks end at their deadlines, so the run stays in real time.
    let pacing = ran.pacing.unwrap();
    assert!(pacing.lateness.figures().worst_ns < 1e6);
    // Only the first silent tick waits longer than that.
    assert_eq!(pacing.missed_deadlines, 1);
    assert!(ran.took < 202 * STEP, "{:?}", ran.took);
}

#[test]
fn a_silent_target_ends_the_run_with_its_damper_time_and_force() {
    let ran = run(100..u32::MAX, true);
    // 0.100 s to 0.140 s: one more than allowed.
    assert_eq!((ran.driven.ticks, ran.records.len()), (140, 140));
    assert!(ran.took < 142 * STEP, "{:?}", ran.took);
    let expected_n = forces_n(&ran.records);
    let held_n = expected_n[98];
    assert!(
        ran.records[100..]
            .iter()
            .all(|(_, force_n)| *force_n == held_n)
    );
    let Ending::OutsideLost { loss, place } = &ran.driven.ending else {
        panic!("{}", ran.driven.ending)
    };
    assert_eq!(loss.dampers, [LostDamper::new(LATERAL, held_n)]);
    assert_eq!(loss.missing_answers, 41);
    assert!((loss.silent_since_s - 0.1).abs() < 1e-9);
    assert!((place.time_s - 0.14).abs() < 1e-9);
    let text = ran.driven.ending.to_string();
    let expected = format!(
        "rig: after tick 99: 41 answers in a row are missing from the target; allowed: 40; use a longer \
         --timeout-ms or more --hold-ticks; no valid answer since 0.100 s, 41 missing; last force, held until the \
         end: {LATERAL} {held_n:.1} N"
    );
    assert!(
        text.starts_with("an external damper was lost at 0.140 s, "),
        "{text}"
    );
    assert!(text.ends_with(&expected), "{text}");
}

/// Without real time the vehicle stands still while the host repeats its request, 47 times the first wait in all.
#[test]
fn without_real_time_the_vehicle_waits_for_a_bounded_time() {
    let ran = run(100..u32::MAX, false);
    assert_eq!((ran.driven.ticks, ran.records.len()), (100, 100));
    let Ending::OutsideLost { loss, place } = &ran.driven.ending else {
        panic!("{}", ran.driven.ending)
    };
    assert!(
        loss.message
            .contains("no answer from the target to 8 tries within 9."),
        "{loss}"
    );
    assert_eq!(
        loss.dampers,
        [LostDamper::new(LATERAL, forces_n(&ran.records)[98])]
    );
    assert_eq!(
        (loss.silent_since_s, loss.missing_answers),
        (place.time_s, 1)
    );
    assert!((place.time_s - 0.1).abs() < 1e-9);
    assert!(ran.took < Duration::from_secs(10), "{:?}", ran.took);
    assert_eq!(ran.lines.lines()[0].silence().missing.missing_answers, 1);
}
