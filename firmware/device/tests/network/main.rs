//! The server on a TCP port, as on boards with a network: bits, lost frames, hosts that vanish.

mod rig;

use dashpot_core::link::{LossOfLink, Reals, Refusal, Request, Response, SafeOutput};
use dashpot_experiment::network::{CLOSED_PORT, Counted, Faults, displacements_m, step_frame};

use rig::{Rig, damper};

/// Time of the watchdog of our board (us).
const WATCHDOG_US: u32 = 100_000;

#[test]
fn twelve_dampers_have_the_hosts_bits_through_lost_and_swapped_frames() {
    let rig = Rig::start();
    rig.cable.set_faults(Faults {
        lost: 20,
        swapped: 20,
    });
    let damper = damper();
    let mut states = [0; 12].map(|_| damper.at_rest(0.0));
    let (mut session, mut compared) = (1, 0);
    for (client, ticks) in [(0, 1..=300), (1, 301..=400)] {
        let mut link = rig.greet(client, session);
        for tick in ticks {
            let displacements_m = displacements_m(tick);
            let expected: Vec<u32> = states
                .iter_mut()
                .zip(&displacements_m)
                .map(|(state, x)| damper.step(state, *x).to_bits())
                .collect();
            let step = Request::Step {
                tick,
                displacements_m,
            };
            let mut is_repeated = false;
            loop {
                let answered = link.request(&step, |response| match response {
                    Response::Forces(forces) => {
                        let found: Vec<u32> = forces.forces_n.iter().map(|n| n.to_bits()).collect();
                        assert_eq!(found, expected, "tick {tick}");
                        compared += 1;
                    }
                    Response::Refused(Refusal::Tick(next)) if is_repeated => {
                        assert_eq!(next, tick + 1, "it was carried out before");
                    }
                    other => panic!("{other:?}"),
                });
                if answered.is_some() {
                    break;
                }
                // A frame that is lost twice costs the connection, but not the dampers' states.
                is_repeated = true;
                session += 1;
                link = rig.greet(client, session);
            }
        }
        session += 1;
        rig.borrow().host.close(client);
        rig.pass(2_500_000);
    }
    assert!(compared > 380, "{compared}");
    assert!(rig.cable.lost_frames() > 20, "{}", rig.cable.lost_frames());
    assert!(rig.longest_without_food_us() < WATCHDOG_US);
}

/// Neither Nagle's algorithm nor a delayed acknowledgement holds up an answer: it is there before any time passes.
#[test]
fn a_step_and_its_answer_are_one_frame_each() {
    let rig = Rig::start();
    for (client, acknowledgements) in [(0, 1), (1, 0)] {
        let session = client as u16 + 5;
        rig.greet(client, session);
        rig.pass(20_000);
        let before = rig.cable.counted();
        let step = step_frame(session, 2, client as u32 + 1);
        let started_us = rig.now_us();
        rig.borrow().host.send(client, step.bytes());
        rig.borrow().settle();
        let mut answer = [0; 600];
        let answered = rig.borrow().host.receive(client, &mut answer);
        assert!(answered > 60 && answer[answered - 1] == 0, "{answered}");
        assert_eq!(rig.now_us(), started_us);
        let after = rig.cable.counted();
        let carried = [0, 1].map(|way| Counted {
            frames: after[way].frames - before[way].frames,
            line_bytes: after[way].line_bytes - before[way].line_bytes,
        });
        // 20 bytes each of IP and TCP, 14 of Ethernet and its checksum, preamble and gap, 24; at least 84 a frame.
        let expected = |bytes: usize, acknowledgements: u32| Counted {
            frames: 1 + acknowledgements,
            line_bytes: bytes as u32 + 78 + 84 * acknowledgements,
        };
        assert_eq!(
            carried,
            [
                expected(step.bytes().len(), acknowledgements),
                expected(answered, 0)
            ]
        );
        rig.borrow().host.close(client);
        rig.pass(200_000);
    }
}

fn all(x: f32) -> Reals {
    (0..12).map(|_| x).collect()
}

#[test]
fn a_host_that_vanishes_loses_the_link_and_then_its_connection() {
    let rig = Rig::start();
    let mut link = rig.greet(0, 20);
    let is_done = |response: Response<'_>| response == Response::Done;
    let has_forces = |response: Response<'_>| matches!(response, Response::Forces(_));
    let loss = LossOfLink {
        after_ticks: 100,
        output: SafeOutput::RampToZero { ticks: 100 },
    };
    assert_eq!(
        link.request(&Request::LossOfLink(loss), is_done),
        Some(true)
    );
    let displacements_m = all(0.0);
    let run = link.request(&Request::Run { displacements_m }, has_forces);
    assert_eq!(run, Some(true));
    for tick in 0..50_u8 {
        rig.pass(1000);
        let displacements_m = all(1e-3 * f32::from(tick % 25));
        let moved = link.request(&Request::Displace { displacements_m }, has_forces);
        assert_eq!(moved, Some(true));
    }
    assert!(rig.outputs_n().iter().any(|force_n| force_n.abs() > 100.0));

    // Another host is refused while this one is connected.
    assert!(!rig.connects(1));

    // Its cable is pulled in the middle of a request. The tick runs on, and the outputs fade.
    rig.cable.set_pulled(true);
    let displacements_m = all(2e-3);
    let silent = link.request(&Request::Displace { displacements_m }, has_forces);
    assert_eq!(silent, None);
    assert_eq!(rig.outputs_n(), [0.0; 12]);
    rig.cable.set_pulled(false);

    let mut link = rig.greet(1, 40);
    let counts = link.request(&Request::Counters, |response| match response {
        Response::Counters(counters) => (counters.link_losses, counters.overruns),
        other => panic!("{other:?}"),
    });
    assert_eq!(counts, Some((1, 0)));
    let displacements_m = all(0.0);
    let refused = link.request(&Request::Displace { displacements_m }, |response| {
        response == Response::Refused(Refusal::LinkLost)
    });
    assert_eq!(refused, Some(true));
    assert!(rig.longest_without_food_us() < WATCHDOG_US);
}

/// A host that is gone is given up after two seconds, neither earlier nor much later.
#[test]
fn a_half_open_connection_ends_after_two_seconds() {
    let rig = Rig::start();
    rig.greet(0, 1);
    // An idle host that is there keeps its connection.
    rig.pass(5_000_000);
    assert!(!rig.connects(1));
    rig.cable.set_pulled(true);
    rig.pass(800_000);
    rig.cable.set_pulled(false);
    assert!(!rig.connects(1), "a short interruption");
    rig.pass(1_000_000);
    rig.cable.set_pulled(true);
    // The host's computer starts again and knows nothing of the connection.
    rig.borrow().host.forget(0);
    rig.pass(2_600_000);
    rig.cable.set_pulled(false);
    assert!(rig.connects(1));
}

#[test]
fn a_host_that_does_not_read_loses_its_connection_and_resets_no_board() {
    let rig = Rig::start();
    rig.greet(0, 8);
    for tick in 1..=100 {
        let step = step_frame(8, tick + 1, tick);
        // There is no room left once the target stops reading.
        rig.borrow().host.send(0, step.bytes());
        rig.pass(100);
    }
    rig.pass(200_000);
    assert!(rig.connects(1));
    assert!(rig.longest_without_food_us() < WATCHDOG_US);
}

/// A flood of frames does not keep the stack from letting the device run.
#[test]
fn the_stack_takes_four_frames_at_a_time() {
    let rig = Rig::start();
    for _ in 0..6 {
        rig.cable.inject(&CLOSED_PORT);
    }
    let waiting = || rig.cable.waiting();
    let before = waiting();
    rig.borrow().run_network_once();
    assert_eq!((before, waiting()), (6, 2));
    rig.borrow().run_network_once();
    assert_eq!(waiting(), 0);
}
