//! Runs a target's bank one tick at a time.

use dashpot_core::Damper;
use dashpot_host_link::{Bank, Client, FaultyLink, Session, SessionError};

use crate::pil_common::{RETRY_LIMITS, built, desk, ride};

const TICKS: usize = 300;

/// Forces of two dampers, the second with the opposite motion, over a faulty link.
fn through(rates: &str) -> (Vec<[f32; 2]>, u64) {
    let link = FaultyLink::new(desk(), rates.parse().unwrap(), 3).unwrap();
    let session = Session::open(Client::new(link, RETRY_LIMITS, 1)).unwrap();
    let mut bank = Bank::start(session, &dampers()).unwrap();
    let forces = ride(TICKS)
        .into_iter()
        .map(|x| bank.step(&[x, -x]).unwrap()[..2].try_into().unwrap());
    let forces = forces.collect();
    let report = bank.finish().unwrap();
    assert_eq!((report.mismatches, report.state_mismatches), (0, 0));
    assert_eq!(report.ticks as usize, TICKS);
    (forces, report.recoveries)
}

fn dampers() -> [Damper<f32>; 2] {
    [built("in-service"), built("reduced-vertical")]
}

#[test]
fn its_forces_are_those_of_the_dampers_from_rest() {
    let (found, _) = through("drop=0");
    let [first, second] = dampers();
    let (mut a, mut b) = (first.at_rest(0.0), second.at_rest(0.0));
    for (found, x) in found.iter().zip(ride(TICKS)) {
        assert_eq!(*found, [first.step(&mut a, x), second.step(&mut b, -x)]);
    }
    assert!(
        found
            .iter()
            .any(|forces| forces[0].abs() > 1.0 && forces[1].abs() > 1.0)
    );
}

#[test]
fn after_a_reset_the_run_continues_with_the_same_bits() {
    let (expected, _) = through("drop=0");
    let (found, recoveries) = through("drop=0.02,corrupt=0.02,reset=0.02");
    assert!(recoveries > 0);
    assert_eq!(found, expected);
}

#[test]
fn zero_dampers_and_more_than_slots_are_refused() {
    let started = |dampers: &[Damper<f32>]| {
        let session = Session::open(Client::new(desk(), RETRY_LIMITS, 1)).unwrap();
        Bank::start(session, dampers).map(|_| ())
    };
    for dampers in [0, 4] {
        let error = started(&vec![built("paper"); dampers]).unwrap_err();
        assert!(
            matches!(error, SessionError::TooManyDampers { slots: 3, .. }),
            "{error}"
        );
    }
}
