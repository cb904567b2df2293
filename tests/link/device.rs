//! Tests of the device: only a valid request in sequence changes a state; everything else is counted and answered.

use dashpot_core::DamperState;
use dashpot_core::link::{
    Header, LossOfLink, PROTOCOL, Parameter, Reals, Refusal, Request, RequestFrame, SafeOutput,
};
use proptest::prelude::*;

use crate::common::{Bench, SESSION, reals};

#[test]
fn steps_give_the_bits_of_the_core() {
    let mut bench = Bench::open();
    bench.done(&Request::Reset {
        displacements_m: reals([1e-3, 0.0]),
    });
    let mut states = [
        bench.dampers[0].at_rest(1e-3),
        bench.dampers[1].at_rest(0.0),
    ];
    for tick in 1..=2000 {
        let x = [1e-3 + 8e-3 * (0.02 * tick as f32).sin(), f32::NAN];
        let x = if tick % 7 == 0 { x } else { [x[0], 2e-3] };
        let forces = bench.step(tick, x).forces();
        assert_eq!(forces.tick, tick);
        for (slot, state) in states.iter_mut().enumerate() {
            let force = bench.dampers[slot].step(state, x[slot]);
            assert_eq!(forces.forces_n[slot].to_bits(), force.to_bits());
            assert_eq!(forces.status[slot], state.status().bits());
        }
    }
    let expected: Vec<u8> = states
        .iter()
        .flat_map(DamperState::<f32>::to_bytes)
        .collect();
    assert_eq!(bench.states(), (2000, expected));
}

#[test]
fn a_repeated_request_gets_the_same_answer_and_no_second_step() {
    let mut bench = Bench::open();
    let first = bench.step(1, [1e-3, 2e-3]);
    let after = bench.states();
    let again = Request::Step {
        tick: 1,
        displacements_m: reals([1e-3, 2e-3]),
    };
    for _ in 0..3 {
        assert_eq!(bench.send(bench.header, &again), first);
    }
    // Noise in between does not discard the stored answer.
    let noise = bench.feed(&[1, 2, 3, 0]);
    assert_eq!(noise[0].refusal(), Some(Refusal::Corrupt));
    assert_eq!(bench.send(bench.header, &again), first);
    assert_eq!(bench.states(), after);
    assert_eq!(bench.counters().repeated, 4);
    // A request with the same number but different content is not a repetition.
    let other = bench.send(bench.header, &Request::Save);
    assert_eq!(
        other.refusal(),
        Some(Refusal::OutOfOrder(bench.header.sequence + 1))
    );
}

#[test]
fn requests_out_of_sequence_or_session_move_nothing() {
    let mut bench = Bench::new();
    let step = Request::Step {
        tick: 1,
        displacements_m: reals([1e-3, 2e-3]),
    };
    let rest = bench.states();
    assert_eq!(bench.ask(&step).refusal(), Some(Refusal::NoSession));
    bench.ask(&Request::Hello { protocol: PROTOCOL });
    let last = bench.header.sequence;
    for sequence in [last + 2, last - 1, last + 1000, u32::MAX] {
        let header = Header {
            sequence,
            ..bench.header
        };
        let refusal = bench.send(header, &step).refusal();
        assert_eq!(refusal, Some(Refusal::OutOfOrder(last + 1)));
    }
    let header = Header {
        session: SESSION + 5,
        sequence: last + 1,
    };
    assert_eq!(
        bench.send(header, &step).refusal(),
        Some(Refusal::NoSession)
    );
    for (tick, expected) in [(0, 1), (2, 1), (u32::MAX, 1)] {
        let refusal = bench.step(tick, [1e-3, 2e-3]).refusal();
        assert_eq!(refusal, Some(Refusal::Tick(expected)));
    }
    assert_eq!(bench.states(), rest);
    let counters = bench.counters();
    assert_eq!(
        (counters.no_session, counters.out_of_order, counters.refused),
        (2, 4, 3)
    );
    assert_eq!(bench.step(1, [1e-3, 2e-3]).forces().tick, 1);
}

#[test]
fn another_protocol_opens_no_session() {
    let mut bench = Bench::new();
    let refusal = bench
        .ask(&Request::Hello {
            protocol: PROTOCOL + 1,
        })
        .refusal();
    assert_eq!(refusal, Some(Refusal::Protocol(PROTOCOL)));
    assert_eq!(
        bench.ask(&Request::Save).refusal(),
        Some(Refusal::NoSession)
    );
}

#[test]
fn a_wrong_request_is_refused_and_changes_nothing() {
    let mut bench = Bench::open();
    bench.step(1, [1e-3, 2e-3]);
    let before = bench.states();
    let short: Reals = [1e-3].into_iter().collect();
    let clearance = |damper, value| Request::Set {
        damper,
        parameter: Parameter::ClearanceM,
        value,
    };
    let (mut other, mut saved) = (before.1.clone(), before.1.clone());
    other[16] ^= 1; // the revision
    saved[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
    let wrong = [
        (
            Request::Step {
                tick: 2,
                displacements_m: short.clone(),
            },
            Refusal::Count(2),
        ),
        (
            Request::Reset {
                displacements_m: short,
            },
            Refusal::Count(2),
        ),
        (
            Request::Reset {
                displacements_m: reals([f32::NAN, 0.0]),
            },
            Refusal::Range,
        ),
        (clearance(2, 1e-3), Refusal::Damper(2)),
        (clearance(0, -1e-3), Refusal::Range),
        (clearance(0, 0.11), Refusal::Range),
        (clearance(0, f32::NAN), Refusal::Range),
        (
            Request::Set {
                damper: 0,
                parameter: Parameter::StiffnessNPerM,
                value: 1e6,
            },
            Refusal::NeedsRebuild,
        ),
        (
            Request::Restore {
                tick: 9,
                states: &before.1[1..],
            },
            Refusal::Count(2),
        ),
        (
            Request::Restore {
                tick: 9,
                states: &other,
            },
            Refusal::State,
        ),
        (
            Request::Restore {
                tick: 9,
                states: &saved,
            },
            Refusal::State,
        ),
        (
            Request::Displace {
                displacements_m: reals([0.0; 2]),
            },
            Refusal::NotRunning,
        ),
        (Request::Stop, Refusal::NotRunning),
        (
            Request::Load {
                damper: 2,
                image: &[1],
            },
            Refusal::Damper(2),
        ),
        (Request::Telemetry { damper: 2 }, Refusal::Damper(2)),
        (
            Request::LossOfLink(LossOfLink {
                after_ticks: 0,
                output: SafeOutput::Zero,
            }),
            Refusal::Range,
        ),
    ];
    for (request, refusal) in &wrong {
        assert_eq!(bench.ask(request).refusal(), Some(*refusal), "{request:?}");
    }
    assert_eq!(bench.states(), before);
    assert_eq!(bench.counters().refused, wrong.len() as u32);
}

#[test]
fn a_restored_device_continues_bit_for_bit() {
    let mut bench = Bench::open();
    let x = |tick: u32| [4e-3 * (0.05 * tick as f32).sin(), 1e-5 * tick as f32];
    let mut saved = (0, Vec::new());
    let mut expected = Vec::new();
    for tick in 1..=400 {
        if tick == 201 {
            saved = bench.states();
        }
        expected.push(bench.step(tick, x(tick)).forces());
    }
    bench.done(&Request::Restore {
        tick: saved.0,
        states: &saved.1,
    });
    for tick in 201..=400 {
        assert_eq!(
            bench.step(tick, x(tick)).forces(),
            expected[tick as usize - 1]
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Arbitrary bytes, and modified real frames, change no state.
    #[test]
    fn no_bytes_but_a_valid_step_move_a_state(
        noise in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..200), 1..20),
        flips in prop::collection::vec(any::<prop::sample::Index>(), 1..20),
    ) {
        let mut bench = Bench::open();
        bench.step(1, [1e-3, 2e-3]);
        let before = bench.states();
        let mut frame = RequestFrame::new();
        let header = Header { sequence: bench.header.sequence + 1, ..bench.header };
        let step = Request::Step { tick: 2, displacements_m: reals([5e-3, 0.0]) };
        prop_assert!(frame.write(&(header, step)));
        for (noise, flip) in noise.iter().zip(flips.iter().cycle()) {
            bench.feed(noise);
            bench.feed(&[0]);
            let mut wrong = frame.bytes().to_vec();
            let bit = flip.index(8 * wrong.len());
            wrong[bit / 8] ^= 1 << (bit % 8);
            bench.feed(&wrong);
            bench.feed(&[0]);
        }
        prop_assert_eq!(bench.states(), before);
        let counters = bench.counters();
        prop_assert!(counters.corrupt >= noise.len() as u32);
        // Afterwards the device continues as if nothing had happened.
        let forces = bench.step(2, [5e-3, 0.0]).forces();
        let mut state = bench.dampers[0].at_rest(0.0);
        bench.dampers[0].step(&mut state, 1e-3);
        prop_assert_eq!(forces.forces_n[0].to_bits(), bench.dampers[0].step(&mut state, 5e-3).to_bits());
    }

    /// A valid frame with any body is executed or refused, never causes a panic, and always has one answer.
    #[test]
    fn any_message_is_answered(bodies in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..100), 1..50)) {
        let mut bench = Bench::open();
        for body in bodies {
            struct Raw<'a>(&'a [u8]);
            impl serde::Serialize for Raw<'_> {
                fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    use serde::ser::SerializeTuple;
                    let mut tuple = serializer.serialize_tuple(self.0.len())?;
                    for byte in self.0 {
                        tuple.serialize_element(byte)?;
                    }
                    tuple.end()
                }
            }
            bench.header.sequence += 1;
            let mut frame = RequestFrame::new();
            prop_assert!(frame.write(&(bench.header, Raw(&body))));
            let answers = bench.feed(frame.bytes());
            prop_assert_eq!(answers.len(), 1);
            prop_assert_eq!(answers[0].response().0, bench.header);
        }
    }
}
