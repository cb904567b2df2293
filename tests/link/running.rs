//! The free-running tick: the outputs after a loss of the link, and the requests that a host may send.

use std::collections::VecDeque;

use dashpot_core::Status;
use dashpot_core::link::{Line, LossOfLink, Outputs, Refusal, Request, SafeOutput, request_frame};

use crate::common::{Bench, reals};

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
        bench.device.tick(3); // while the host steps, no time passes
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
fn telemetry_has_the_last_ticks_of_every_damper() {
    let mut bench = Bench::open();
    assert_eq!(bench.telemetry(1), (0, Vec::new()));
    let mut forces = Vec::new();
    for tick in 1..=70 {
        let x = tick as f32 / 65_536.0;
        forces.push(bench.step(tick, [-x, x]).forces().forces_n);
    }
    // The ring has 64 samples; displacements on the step's grid are used unchanged. Reading one damper's samples does
    // not remove the other's.
    for (slot, sign, first) in [(1, 1.0, 7), (0, -1.0, 7), (1, 1.0, 15)] {
        let (overwritten, samples) = bench.telemetry(slot);
        assert_eq!((overwritten, samples.len()), (6, 8));
        for (sample, tick) in samples.iter().zip(first..) {
            assert_eq!(sample.tick, tick);
            assert_eq!(sample.force_n, forces[tick as usize - 1][usize::from(slot)]);
            assert_eq!(sample.displacement_m, sign * tick as f32 / 65_536.0);
        }
    }
    // Returns the remaining samples, then none.
    let left: Vec<usize> = (0..8).map(|_| bench.telemetry(0).1.len()).collect();
    assert_eq!(left, [8, 8, 8, 8, 8, 8, 8, 0]);
}

#[test]
fn status_and_rejected_inputs_are_read_and_cleared() {
    let mut bench = Bench::open();
    bench.step(1, [1e-3, f32::NAN]);
    bench.step(2, [f32::INFINITY, f32::NAN]);
    let (held, none) = (Status::INPUT_HELD.bits(), 0);
    let expected = (vec![held, held], vec![1, 2]);
    assert_eq!(bench.status(&Request::Status), expected);
    assert_eq!(bench.status(&Request::ClearStatus), expected);
    assert_eq!(bench.status(&Request::Status), (vec![none; 2], vec![0; 2]));
    assert_eq!(bench.step(3, [1e-3, 0.0]).forces().status[..], [none; 2]);
}

/// A line that delivers a frame and accepts the answer, a few bytes per pass.
#[derive(Default)]
struct Wire {
    waiting: VecDeque<u8>,
    answer: Vec<u8>,
    room: usize,
}

impl Line for Wire {
    fn receive(&mut self) -> Option<u8> {
        self.waiting.pop_front()
    }
    fn send(&mut self, byte: u8) -> bool {
        let sent = self.room > 0;
        if sent {
            self.room -= 1;
            self.answer.push(byte);
        }
        sent
    }
}

/// Outputs that record their forces.
#[derive(Default)]
struct Actuators(Vec<[f32; 2]>);

impl Outputs<2> for Actuators {
    fn drive(&mut self, forces_n: &[f32; 2]) {
        self.0.push(*forces_n);
    }
}

#[test]
fn a_pass_of_the_loop_never_waits_and_drives_the_outputs_at_every_tick() {
    let mut bench = Bench::open();
    let (mut wire, mut actuators) = (Wire::default(), Actuators::default());
    let mut passes = 0;
    let mut ask = |bench: &mut Bench, request: &Request<'_>, due: u32| {
        bench.header.sequence += 1;
        let frame = request_frame(bench.header, request);
        wire.waiting.extend(frame.bytes());
        while !wire.waiting.is_empty() || bench.device.is_sending() {
            wire.room = 3;
            let sent = wire.answer.len();
            bench.device.poll(due, &mut wire, &mut actuators);
            assert!(wire.answer.len() <= sent + 3, "what the line takes");
            passes += due;
        }
        assert_eq!(std::mem::take(&mut wire.answer), bench.device.response());
    };
    let run = Request::Run {
        displacements_m: reals([0.0; 2]),
    };
    ask(&mut bench, &run, 0);
    let displace = Request::Displace {
        displacements_m: reals([2e-3; 2]),
    };
    ask(&mut bench, &displace, 1);
    ask(&mut bench, &Request::Counters, 1);
    assert_eq!(bench.device.tick_number(), passes);
    assert!(actuators.0.len() > passes as usize);
    assert_eq!(actuators.0.last(), Some(bench.device.outputs_n()));
    assert!(
        actuators
            .0
            .iter()
            .any(|forces| forces.iter().all(|force| *force > 100.0))
    );
}
