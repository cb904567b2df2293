//! The device: only a valid request, in sequence, moves a state; everything else is counted and answered.

use dashpot::damper;
use dashpot_core::link::{
    CHUNK_BYTES, Clock, Counters, Device, Forces, Frame, FrameReader, Header, LossOfLink, PROTOCOL,
    Parameter, Reals, Refusal, Request, Response, SafeOutput, bank_revision,
};
use dashpot_core::{Damper, DamperState};
use proptest::prelude::*;

const SESSION: u16 = 77;

fn built(name: &str, overrides: &[&str]) -> Damper<f32> {
    damper(name, overrides).build(1e-3).unwrap()
}

/// Two different dampers behind a link, and the header of the next request.
struct Bench {
    device: Device<2>,
    dampers: [Damper<f32>; 2],
    header: Header,
}

/// What came back, and what it said.
#[derive(Clone, Debug, PartialEq)]
struct Answer(Vec<u8>);

impl Answer {
    fn response(&self) -> (Header, Response<'_>) {
        postcard::from_bytes(&self.0).unwrap()
    }
    fn refusal(&self) -> Option<Refusal> {
        match self.response().1 {
            Response::Refused(refusal) => Some(refusal),
            _ => None,
        }
    }
    fn forces(&self) -> Forces {
        match self.response().1 {
            Response::Forces(forces) => forces,
            other => panic!("{other:?}"),
        }
    }
}

fn reals(values: [f32; 2]) -> Reals {
    values.into_iter().collect()
}

impl Bench {
    fn new() -> Self {
        let dampers = [built("in-service", &[]), built("reduced-vertical", &[])];
        let clock = Clock { now: || 0, hz: 1 };
        let device = Device::new(&dampers.each_ref(), clock);
        let header = Header {
            session: SESSION,
            sequence: 0,
        };
        Self {
            device,
            dampers,
            header,
        }
    }

    /// With a session open.
    fn open() -> Self {
        let mut bench = Self::new();
        let hello = bench.ask(&Request::Hello { protocol: PROTOCOL });
        assert!(matches!(hello.response().1, Response::Welcome(_)));
        bench
    }

    fn feed(&mut self, bytes: &[u8]) -> Vec<Answer> {
        let mut answers = Vec::new();
        for byte in bytes {
            if self.device.receive(*byte) {
                let mut reader = FrameReader::new();
                let response = self.device.response().to_vec();
                let message = response.iter().find_map(|byte| {
                    reader
                        .push(*byte)
                        .map(|message| message.unwrap().bytes.to_vec())
                });
                answers.push(Answer(message.unwrap()));
            }
        }
        answers
    }

    fn send(&mut self, header: Header, request: &Request<'_>) -> Answer {
        let mut frame = Frame::new();
        assert!(frame.write(&(header, request)));
        let mut answers = self.feed(frame.bytes());
        assert_eq!(answers.len(), 1);
        answers.remove(0)
    }

    fn ask(&mut self, request: &Request<'_>) -> Answer {
        self.header.sequence += 1;
        self.send(self.header, request)
    }

    fn done(&mut self, request: &Request<'_>) {
        let answer = self.ask(request);
        assert_eq!(answer.response(), (self.header, Response::Done));
    }

    fn step(&mut self, tick: u32, x: [f32; 2]) -> Answer {
        self.ask(&Request::Step {
            tick,
            displacements_m: reals(x),
        })
    }

    /// Tick and states, asked in a session of its own that leaves no trace in the one under test.
    fn states(&self) -> (u32, Vec<u8>) {
        let mut other = Bench {
            device: self.device.clone(),
            dampers: self.dampers,
            header: self.header,
        };
        other.header = Header {
            session: SESSION + 1,
            sequence: 0,
        };
        other.ask(&Request::Hello { protocol: PROTOCOL });
        match other.ask(&Request::Save).response().1 {
            Response::Saved { tick, states } => (tick, states.to_vec()),
            other => panic!("{other:?}"),
        }
    }

    fn counters(&self) -> Counters {
        self.device.counters()
    }

    fn load(&mut self, place: u8, image: &[u8]) -> Answer {
        let bytes = image.len() as u32;
        self.done(&Request::BeginLoad {
            damper: place,
            bytes,
        });
        for (index, bytes) in image.chunks(CHUNK_BYTES).enumerate() {
            let offset = (index * CHUNK_BYTES) as u32;
            self.done(&Request::Chunk { offset, bytes });
        }
        self.ask(&Request::CommitLoad)
    }
}

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
        for (place, state) in states.iter_mut().enumerate() {
            let force = bench.dampers[place].step(state, x[place]);
            assert_eq!(forces.forces_n[place].to_bits(), force.to_bits());
            assert_eq!(forces.status[place], state.status().bits());
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
    // Noise in between does not lose the stored answer.
    let noise = bench.feed(&[1, 2, 3, 0]);
    assert_eq!(noise[0].refusal(), Some(Refusal::Corrupt));
    assert_eq!(bench.send(bench.header, &again), first);
    assert_eq!(bench.states(), after);
    assert_eq!(bench.counters().repeated, 4);
    // The same number with another content is no repetition.
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
        (Request::CommitLoad, Refusal::NoLoad),
        (
            Request::Chunk {
                offset: 0,
                bytes: &[1],
            },
            Refusal::NoLoad,
        ),
        (
            Request::BeginLoad {
                damper: 0,
                bytes: 3,
            },
            Refusal::ImageBytes(Damper::<f32>::IMAGE_BYTES as u32),
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
fn a_damaged_damper_is_refused_whole() {
    let mut bench = Bench::open();
    bench.step(1, [1e-3, 2e-3]);
    let before = bench.states();
    let revision = bank_revision(bench.dampers.iter().map(Damper::revision));
    let image = built("paper", &[]).to_image();
    for bit in [0, 8 * 500 + 3, 8 * image.len() - 1] {
        let mut wrong = image;
        wrong[bit / 8] ^= 1 << (bit % 8);
        assert_eq!(bench.load(0, &wrong).refusal(), Some(Refusal::Image));
    }
    let slower: Damper<f32> = damper("paper", &[]).build(2e-3).unwrap();
    let refusal = bench.load(0, &slower.to_image()).refusal();
    assert_eq!(refusal, Some(Refusal::StepSize));

    // Half an image, then a chunk in the wrong place, then a commit too early.
    let bytes = image.len() as u32;
    bench.done(&Request::BeginLoad { damper: 0, bytes });
    bench.done(&Request::Chunk {
        offset: 0,
        bytes: &image[..200],
    });
    let gap = bench.ask(&Request::Chunk {
        offset: 400,
        bytes: &image[400..500],
    });
    assert_eq!(gap.refusal(), Some(Refusal::Offset(200)));
    let early = bench.ask(&Request::CommitLoad);
    assert_eq!(early.refusal(), Some(Refusal::Offset(200)));
    assert_eq!(bench.states(), before);

    let header = bench.header;
    bench.header.session += 1;
    let hello = bench.ask(&Request::Hello { protocol: PROTOCOL });
    match hello.response().1 {
        Response::Welcome(welcome) => assert_eq!(welcome.bank_revision, revision),
        other => panic!("{other:?} to {header:?}"),
    }
}

#[test]
fn a_loaded_damper_and_a_set_clearance_go_on_with_the_cores_bits() {
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
            damper.set_clearance_m(1.5e-3);
        }
        let x = 6e-3 * (0.03 * tick as f32).sin();
        let force = damper.step(&mut state, x);
        let answer = bench.step(tick, [x, 0.0]).forces();
        assert_eq!(answer.forces_n[0].to_bits(), force.to_bits(), "tick {tick}");
        assert_eq!(answer.status[0], state.status().bits());
    }
}

#[test]
fn a_restored_device_goes_on_to_the_bit() {
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

#[test]
fn a_lost_link_ends_in_the_safe_output_until_run() {
    for (output, shares) in [
        (SafeOutput::Hold, [1.0, 1.0, 1.0, 1.0, 1.0]),
        (SafeOutput::Zero, [0.0; 5]),
        (
            SafeOutput::RampToZero { ticks: 4 },
            [0.75, 0.5, 0.25, 0.0, 0.0],
        ),
    ] {
        let mut bench = Bench::open();
        let configuration = LossOfLink {
            after_ticks: 5,
            output,
        };
        bench.done(&Request::LossOfLink(configuration));
        bench.device.tick(3); // the host steps: no time passes
        assert_eq!(bench.states().0, 0);
        let run = Request::Run {
            displacements_m: reals([0.0; 2]),
        };
        assert_eq!(bench.ask(&run).forces().tick, 0);
        for tick in 1..=50 {
            let x = [1e-4 * tick as f32; 2];
            bench.ask(&Request::Displace {
                displacements_m: reals(x),
            });
            bench.device.tick(1);
        }
        assert!(bench.device.outputs_n().iter().all(|force| *force > 100.0));
        bench.device.tick(4);
        let last_good = *bench.device.outputs_n();
        assert_eq!(bench.counters().link_losses, 0);
        for share in shares {
            bench.device.tick(1);
            let expected = last_good.map(|force| force * share);
            assert_eq!(*bench.device.outputs_n(), expected, "{output:?}");
        }
        assert_eq!(bench.counters().link_losses, 1);
        assert_eq!(bench.counters().overruns, 3);
        assert_eq!(bench.states().0, 59);
        let displace = Request::Displace {
            displacements_m: reals([0.0; 2]),
        };
        assert_eq!(bench.ask(&displace).refusal(), Some(Refusal::LinkLost));
        assert_eq!(bench.ask(&run).forces().forces_n[..], [0.0; 2]);
        assert_eq!(bench.ask(&displace).forces().tick, 0);
        bench.done(&Request::Stop);
        assert_eq!(*bench.device.outputs_n(), [0.0; 2]);
    }
}

#[test]
fn outputs_stay_zero_while_the_host_steps() {
    let mut bench = Bench::open();
    for tick in 1..=50 {
        let step = Request::Step {
            tick,
            displacements_m: reals([1e-4 * tick as f32; 2]),
        };
        let forces = bench.ask(&step).forces().forces_n;
        assert!(tick < 50 || forces.iter().all(|force| *force > 100.0));
        assert_eq!(*bench.device.outputs_n(), [0.0; 2]);
    }
}

#[test]
fn while_the_tick_runs_free_the_host_cannot_step() {
    let mut bench = Bench::open();
    let start = reals([0.0; 2]);
    bench.ask(&Request::Run {
        displacements_m: start.clone(),
    });
    let states = bench.states().1;
    let refused = [
        Request::Step {
            tick: 1,
            displacements_m: start.clone(),
        },
        Request::Reset {
            displacements_m: start.clone(),
        },
        Request::Restore {
            tick: 0,
            states: &states,
        },
        Request::Run {
            displacements_m: start,
        },
    ];
    for request in &refused {
        assert_eq!(bench.ask(request).refusal(), Some(Refusal::Running));
    }
}

#[test]
fn telemetry_has_the_last_ticks_of_the_chosen_damper() {
    let mut bench = Bench::open();
    let empty = bench.ask(&Request::Telemetry { damper: 1 });
    assert!(
        matches!(empty.response().1, Response::Telemetry { samples, .. } if samples.is_empty())
    );
    let mut forces = Vec::new();
    for tick in 1..=70 {
        forces.push(
            bench
                .step(tick, [0.0, tick as f32 / 65_536.0])
                .forces()
                .forces_n[1],
        );
    }
    let answer = bench.ask(&Request::Telemetry { damper: 1 });
    let Response::Telemetry {
        overwritten,
        samples,
    } = answer.response().1
    else {
        panic!("{answer:?}");
    };
    // A ring of 64; displacements on the step's grid are used as they are.
    assert_eq!((overwritten, samples.len()), (6, 8));
    for (sample, tick) in samples.iter().zip(7..) {
        assert_eq!(sample.tick, tick);
        assert_eq!(sample.force_n, forces[tick as usize - 1]);
        assert_eq!(sample.displacement_m, tick as f32 / 65_536.0);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any bytes, and real frames with anything done to them, move no state.
    #[test]
    fn no_bytes_but_a_valid_step_move_a_state(
        noise in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..200), 1..20),
        flips in prop::collection::vec(any::<prop::sample::Index>(), 1..20),
    ) {
        let mut bench = Bench::open();
        bench.step(1, [1e-3, 2e-3]);
        let before = bench.states();
        let mut frame = Frame::new();
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
        // And then it goes on as if nothing had been.
        let forces = bench.step(2, [5e-3, 0.0]).forces();
        let mut state = bench.dampers[0].at_rest(0.0);
        bench.dampers[0].step(&mut state, 1e-3);
        prop_assert_eq!(forces.forces_n[0].to_bits(), bench.dampers[0].step(&mut state, 5e-3).to_bits());
    }

    /// Valid frames with any body: carried out or refused, never a panic, always one answer.
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
            let mut frame = Frame::new();
            prop_assert!(frame.write(&(bench.header, Raw(&body))));
            let answers = bench.feed(frame.bytes());
            prop_assert_eq!(answers.len(), 1);
            prop_assert_eq!(answers[0].response().0, bench.header);
        }
    }
}
