//! A damper is loaded over the link completely or not at all, in slices, while the others step.

use dashpot::damper;
use dashpot_core::link::{PROTOCOL, Parameter, Refusal, Request, Response, request_frame};
use dashpot_core::{Damper, ImageError};

use crate::common::{Bench, built, reals};

#[test]
fn a_damaged_damper_is_refused_whole() {
    let mut bench = Bench::open();
    bench.step(1, [1e-3, 2e-3]);
    let before = bench.states();
    let image = built("paper", &[]).to_image();
    for bit in [0, 8 * 500 + 3, 8 * image.len() - 1] {
        let mut wrong = image;
        wrong[bit / 8] ^= 1 << (bit % 8);
        let error = Damper::<f32>::from_image(&wrong).unwrap_err();
        assert_eq!(bench.load(0, &wrong).refusal(), Some(Refusal::Image(error)));
    }
    let slower: Damper<f32> = damper("paper", &[]).build(2e-3).unwrap();
    let refusal = bench.load(0, &slower.to_image()).refusal();
    assert_eq!(refusal, Some(Refusal::StepSize));

    let cut = bench.load(0, &image[..image.len() - 1]).refusal();
    let (expected, found) = (image.len() as u32, image.len() as u32 - 1);
    let length = ImageError::Length { expected, found };
    assert_eq!(cut, Some(Refusal::Image(length)));
    assert_eq!(bench.states(), before);

    bench.header.session += 1;
    let revisions = bench.dampers.map(|damper| damper.revision());
    let hello = bench.ask(&Request::Hello { protocol: PROTOCOL });
    match hello.response().1 {
        Response::Welcome(welcome) => assert_eq!(welcome.revisions[..], revisions),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_loaded_damper_and_a_set_clearance_continue_with_the_cores_bits() {
    let mut bench = Bench::open();
    let mut damper = bench.dampers[0];
    let mut state = damper.at_rest(0.0);
    for tick in 1..=900 {
        if tick == 300 {
            damper = built("paper", &[]);
            assert_eq!(
                bench.load(0, &damper.to_image()).response().1,
                Response::Done
            );
        }
        if tick == 600 {
            bench.done(&Request::Set {
                damper: 0,
                parameter: Parameter::ClearanceM,
                value: 1.5e-3,
            });
            damper.set_clearance_m(1.5e-3).unwrap();
        }
        let x = 6e-3 * (0.03 * tick as f32).sin();
        let force = damper.step(&mut state, x);
        let answer = bench.step(tick, [x, 0.0]).forces();
        assert_eq!(answer.forces_n[0].to_bits(), force.to_bits(), "tick {tick}");
        assert_eq!(answer.status[0], state.status().bits());
    }
}

/// A load in progress does not change the ticks and their forces. Bytes that arrive during the load are dropped and
/// reported as a broken frame.
#[test]
fn a_load_continues_in_slices_between_the_ticks() {
    let mut bench = Bench::open();
    let start = reals([0.0; 2]);
    bench.ask(&Request::Run {
        displacements_m: start,
    });
    bench.ask(&Request::Displace {
        displacements_m: reals([2e-3, 2e-3]),
    });
    let image = built("paper", &[]).to_image();
    bench.header.sequence += 1;
    let load = Request::Load {
        damper: 0,
        image: &image,
    };
    for byte in request_frame(bench.header, &load).bytes() {
        assert!(!bench.device.receive(*byte));
    }
    let mut states = bench.dampers.map(|damper| damper.at_rest(0.0));
    let mut slices = 0;
    while !bench.device.advance() {
        slices += 1;
        assert!(bench.device.is_busy());
        bench.device.tick(1);
        for ((damper, state), output) in bench
            .dampers
            .iter()
            .zip(&mut states)
            .zip(bench.device.outputs_n())
        {
            // The link is lost after 100 ticks; before that the outputs are the forces.
            let force = damper.step(state, 2e-3);
            assert!(
                slices > 100 || force.to_bits() == output.to_bits(),
                "slice {slices}"
            );
        }
        if slices == 50 {
            for byte in [1, 2, 3] {
                assert!(!bench.device.receive(byte));
            }
        }
    }
    assert!(slices > 200, "{slices}");
    assert!(!bench.device.is_busy());
    // The frame that arrived in between ends now.
    let answers = bench.feed(&[4, 0]);
    assert_eq!(answers[0].refusal(), Some(Refusal::Corrupt));
    bench.header.session += 1;
    let welcome = bench.ask(&Request::Hello { protocol: PROTOCOL });
    let Response::Welcome(welcome) = welcome.response().1 else {
        panic!("no welcome");
    };
    let revision = built("paper", &[]).revision();
    assert_eq!(
        welcome.revisions[..],
        [revision, bench.dampers[1].revision()]
    );
}

#[test]
fn a_dozen_loads_take_a_dozen_frames() {
    let mut bench = Bench::open();
    let before = bench.counters().accepted;
    for round in 0..6 {
        for slot in [0, 1] {
            let set = format!("mount.clearance_m={}", 1e-4 * f64::from(round + 1));
            let image = built("in-service", &[&set]).to_image();
            assert_eq!(bench.load(slot, &image).response().1, Response::Done);
        }
    }
    assert_eq!(bench.counters().accepted - before, 12);
}
