//! A different damper in each slot of the target.

use dashpot_core::Damper;
use dashpot_hil::commands::failure::{Failure, Kind};
use dashpot_host_link::{
    Client, Desk, FaultRates, FaultyLink, Link, Pace, Report, Session, SessionError,
};

use crate::pil_common::{RETRY_LIMITS, built, desk, motion, ride};

/// Runs `dampers`; returns the forces of the target (N), tick by tick.
fn forces(
    link: impl Link,
    dampers: &[Damper<f32>],
    ticks: usize,
) -> Result<(Report, Vec<Vec<f32>>), SessionError> {
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 40))?;
    let mut forces_n = Vec::new();
    let report = session.run(dampers, motion(ticks), &mut Pace::default(), |record| {
        assert_eq!(record.target_forces_n, record.host_forces_n);
        forces_n.push(record.target_forces_n.to_vec());
        Ok(())
    })?;
    Ok((report, forces_n))
}

fn three() -> [Damper<f32>; 3] {
    [
        built("paper"),
        built("in-service"),
        built("reduced-vertical"),
    ]
}

#[test]
fn slot_i_has_damper_i() {
    let dampers = three();
    let (report, forces_n) = forces(desk(), &dampers, 600).unwrap();
    assert_eq!(
        (report.ticks, report.mismatches, report.state_mismatches),
        (600, 0, 0)
    );
    let ride = ride(600);
    for (place, damper) in dampers.iter().enumerate() {
        let mut state = damper.at_rest(ride[0]);
        for (tick, forces_n) in forces_n.iter().enumerate() {
            let expected = damper.step(&mut state, ride[tick.saturating_sub(place)]);
            assert_eq!(forces_n[place], expected, "place {place}, tick {tick}");
        }
        assert!(
            forces_n
                .iter()
                .any(|forces_n| forces_n[place].abs() > 100.0)
        );
    }
}

/// Loading twelve different dampers takes twelve requests, which succeed despite resets at 0.5 % of the frames.
#[test]
fn after_a_reset_each_slot_has_its_damper_again() {
    let dampers: [Damper<f32>; 12] = std::array::from_fn(|place| {
        let mut damper = three()[place % 3];
        damper.set_clearance_m(1e-4 * place as f32).unwrap();
        damper
    });
    let other = Desk::<12>::new([built("reduced-lateral"); 12]).unwrap();
    let rates: FaultRates = "reset=0.005".parse().unwrap();
    let link = FaultyLink::new(other, rates, 3).unwrap();
    let (report, _) = forces(link, &dampers, 2000).unwrap();
    assert_eq!((report.mismatches, report.state_mismatches), (0, 0));
    assert!(report.recoveries > 5, "{}", report.recoveries);
}

#[test]
fn one_damper_is_loaded_into_every_slot() {
    let one = forces(desk(), &[built("paper")], 300).unwrap();
    let three = forces(
        desk(),
        &[built("paper"), built("paper"), built("paper")],
        300,
    )
    .unwrap();
    assert_eq!(one.1, three.1);
}

#[test]
fn another_number_of_dampers_is_refused_before_the_target_is_touched() {
    for count in [0, 2, 4] {
        let dampers = vec![built("paper"); count];
        let mut session = Session::open(Client::new(desk(), RETRY_LIMITS, 40)).unwrap();
        let refused = session.run(&dampers, motion(10), &mut Pace::default(), |_| Ok(()));
        let refused = Failure::from(refused.unwrap_err());
        assert_eq!(refused.kind(), Kind::WrongUse);
        assert_eq!(
            refused.to_string(),
            format!(
                "--damper: {count} dampers, but the target has 3 slots; allowed: 1 for all slots, or 3, one per slot"
            )
        );
        // Only the hello is sent.
        assert_eq!(session.link().device().counters().accepted, 1);
    }
}
