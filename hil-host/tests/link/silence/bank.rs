//! A bank that holds its last forces while its target is silent.

use std::time::Duration;

use dashpot_core::Damper;
use dashpot_host_link::{Bank, Client, Hold, MissingAnswers, RetryLimits, Session, SessionError};
use dashpot_realtime::pacing::Clock;

use super::{FallsSilent, ROUND_TRIP, Silent, SimulatedClock};
use crate::pil_common::{built, ride};

const TICKS: usize = 300;
const ANSWER_WAIT: Duration = Duration::from_millis(1);
const TIME_LEFT: Duration = Duration::from_micros(700);
const HOLD: Hold = Hold::new(ANSWER_WAIT, 100);

fn damper() -> Damper<f32> {
    built("in-service")
}

/// Forces of the damper at each tick.
fn expected_n() -> Vec<f32> {
    let damper = damper();
    let mut state = damper.at_rest(0.0);
    ride(TICKS)
        .into_iter()
        .map(|x| damper.step(&mut state, x))
        .collect()
}

fn started(link: FallsSilent) -> Bank<FallsSilent> {
    let limits = RetryLimits::default();
    let session = Session::open(Client::new(link, limits, 1)).unwrap();
    Bank::start(session, &[damper()]).unwrap()
}

/// Forces and duration (ns) of each tick up to an error.
fn run(
    bank: &mut Bank<FallsSilent>,
    clock: &SimulatedClock,
) -> Vec<Result<(f32, u64), SessionError>> {
    let mut results = Vec::new();
    for x in ride(TICKS) {
        let before_ns = clock.now_ns();
        let stepped = bank.step_or_hold(&[x], TIME_LEFT, &HOLD);
        let stepped = stepped.map(|forces_n| forces_n[0]);
        results.push(stepped.map(|force_n| (force_n, clock.now_ns() - before_ns)));
        if results.last().is_some_and(Result::is_err) {
            break;
        }
    }
    results
}

fn counts(missing: MissingAnswers) -> (u64, u64, u64) {
    (
        missing.missing_answers,
        missing.most_missing_in_a_row,
        missing.in_a_row,
    )
}

/// The target is silent for ticks 11 to 20, in each of the ways.
#[test]
fn the_last_force_is_held_and_the_run_continues_with_the_same_bits() {
    let expected_n = expected_n();
    for (kind, recoveries, stale) in [
        (Silent::Deaf, 1, 0),
        (Silent::Mute, 0, 0),
        (Silent::Late, 0, 10),
    ] {
        let clock = SimulatedClock::default();
        let mut bank = started(FallsSilent::new(kind, 11..21, &clock));
        let results = run(&mut bank, &clock);
        assert_eq!(results.len(), TICKS);
        for (index, result) in results.into_iter().enumerate() {
            let (force_n, took_ns) = result.unwrap();
            let tick = index + 1;
            let is_silent = (11..21).contains(&tick);
            let source = if is_silent { 9 } else { index };
            assert_eq!(
                force_n.to_bits(),
                expected_n[source].to_bits(),
                "tick {tick}"
            );
            let wait = match tick {
                11 => ANSWER_WAIT,
                12..21 => TIME_LEFT,
                // A recovery: a refused step, a new session, the states, and the step again.
                21 => ROUND_TRIP * (1 + 3 * recoveries),
                _ => ROUND_TRIP,
            };
            assert_eq!(u128::from(took_ns), wait.as_nanos(), "tick {tick}");
        }
        assert_eq!(counts(bank.missing_answers()), (10, 10, 0));
        let report = bank.finish().unwrap();
        assert_eq!(
            (report.ticks, report.recoveries),
            (300, u64::from(recoveries))
        );
        assert_eq!((report.mismatches, report.state_mismatches), (0, 0));
        assert_eq!(report.link_faults.stale_answers, stale);
        assert_eq!(report.link_faults.repeated_requests, 0);
        assert_eq!(report.round_trip.count, 290);
    }
}

#[test]
fn a_target_that_stays_silent_is_given_up_after_the_allowed_ticks() {
    let clock = SimulatedClock::default();
    let link = FallsSilent::new(Silent::Deaf, 11..u32::MAX, &clock);
    let unheard = link.unheard.clone();
    let mut bank = started(link);
    let begun_ns = clock.now_ns();
    let mut results = run(&mut bank, &clock);
    // Ten answers, a hundred held forces, and the error.
    assert_eq!(results.len(), 111);
    let error = results.pop().unwrap().unwrap_err();
    assert_eq!(
        error.to_string(),
        "after tick 10: 101 answers in a row are missing from the target; allowed: 100"
    );
    let held_n = expected_n()[9];
    assert!(
        results[10..]
            .iter()
            .all(|result| result.as_ref().unwrap().0 == held_n)
    );
    assert_eq!(bank.forces_n()[0], held_n);
    assert_eq!(counts(bank.missing_answers()), (101, 101, 101));
    // One request a tick, and no longer than the ticks last.
    assert_eq!(unheard.load(std::sync::atomic::Ordering::Relaxed), 101);
    let taken = Duration::from_nanos(clock.now_ns() - begun_ns);
    assert_eq!(taken, 10 * ROUND_TRIP + ANSWER_WAIT + 100 * TIME_LEFT);
}

#[test]
fn without_an_answer_the_force_is_zero() {
    let clock = SimulatedClock::default();
    let mut bank = started(FallsSilent::new(Silent::Deaf, 1..4, &clock));
    let results = run(&mut bank, &clock);
    let forces_n: Vec<f32> = results
        .into_iter()
        .map(|result| result.unwrap().0)
        .collect();
    assert_eq!(forces_n[..3], [0.0; 3]);
    assert_eq!(forces_n[3..], expected_n()[3..]);
}

/// The target missed the last ticks, so its states are restored before they are compared.
#[test]
fn a_silence_at_the_end_of_a_run_is_no_mismatch() {
    let clock = SimulatedClock::default();
    let mut link = FallsSilent::new(Silent::Deaf, 291..301, &clock);
    link.ends_with_hello = true;
    let mut bank = started(link);
    assert!(run(&mut bank, &clock).iter().all(Result::is_ok));
    assert_eq!(counts(bank.missing_answers()), (10, 10, 10));
    let report = bank.finish().unwrap();
    assert_eq!((report.state_mismatches, report.recoveries), (0, 1));
}
