//! The locomotive and a rig on both ends of a wire that loses, delays, repeats and reorders datagrams.

use std::collections::BTreeMap;
use std::fmt::Write;

use dashpot::document;
use dashpot_core::hybrid::wire::InboxCounts;
use dashpot_core::hybrid::{HybridStatus, Measured};
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_hybrid::rig::{KeeperSettings, RigClient, RigServer, VirtualRig};
use dashpot_hybrid::{Compensation, Coupling, Specimen};
use dashpot_vehicle_run::{Run, outside_index};

use crate::DOCUMENT;
use crate::coupled::settings;

const DAMPER: &str = "front lateral damper 1";
const SESSION: u32 = 7;

/// What the wire does with a datagram, by the tick in which it is sent: the ticks after which copies of it arrive.
type Wire = fn(&mut fastrand::Rng, u64) -> Vec<u64>;

/// Datagrams in one direction.
#[derive(Default)]
struct Direction {
    arriving: BTreeMap<u64, Vec<Vec<u8>>>,
}

impl Direction {
    fn send(&mut self, tick: u64, delays: &[u64], bytes: &[u8]) {
        for delay in delays {
            self.arriving
                .entry(tick + delay)
                .or_default()
                .push(bytes.to_vec());
        }
    }

    fn receive(&mut self, tick: u64) -> Vec<Vec<u8>> {
        self.arriving.remove(&tick).unwrap_or_default()
    }
}

/// A fault of the wire, or of a process at its end.
struct Fault {
    name: &'static str,
    wire: Wire,
    /// Ticks in which the vehicle makes none, and the rig goes on.
    suspended: std::ops::Range<u64>,
    /// Datagrams of others that arrive at both ends in each tick.
    foreign: usize,
    /// True if the test must go on.
    goes_on: bool,
}

/// What the test found.
#[derive(Debug)]
struct Outcome {
    status: HybridStatus,
    acted: Option<u64>,
    fastest_m_per_s: f64,
    rig_is_held: bool,
    commands: InboxCounts,
    /// Answers that are lost.
    lost_answers: u32,
}

const TICKS: u64 = 6000;
/// Tick in which the fault begins.
const BEGIN: u64 = 3000;

fn run(fault: &Fault) -> Outcome {
    let mut case = Case::load("straight-180").unwrap();
    case.duration_s = 10.0;
    let servo = ActuatorParameters::load("servo").unwrap();
    let damper = outside_index(&case, DAMPER, &[]).unwrap();
    let parameters = case.damper(DAMPER).unwrap().clone().check().unwrap();
    let specimen = Specimen::at_velocity(&parameters, 1e-3);
    let compensator = Compensation::Adaptive
        .build(&servo, &specimen, case.step_s)
        .unwrap();
    let limits = settings(&servo);
    let mut coupling = Coupling::new(compensator, &limits, case.step_s).unwrap();
    let rig = VirtualRig::new(&servo, &parameters, case.step_s, 1).unwrap();
    let keeper = KeeperSettings {
        extrapolated_ticks: 10,
        ramp_s: 0.2,
        velocity_m_per_s: servo.limits.velocity_m_per_s,
        stroke_m: servo.limits.stroke_m,
    };
    let mut server = RigServer::new(rig, keeper, case.step_s);
    let mut client = RigClient::new(SESSION, case.step_s);
    let mut run = Run::new(&case).unwrap();
    let mut random = fastrand::Rng::with_seed(3);
    let (mut to_rig, mut to_vehicle) = (Direction::default(), Direction::default());
    let mut acted = None;
    let mut status = HybridStatus::empty();
    let (mut last_m, mut fastest_m_per_s) = (0.0, 0.0_f64);
    for tick in 0..TICKS {
        let is_faulty = tick >= BEGIN;
        let delays = |random: &mut fastrand::Rng| match is_faulty {
            true => (fault.wire)(random, tick),
            false => vec![0],
        };
        if !(is_faulty && fault.suspended.contains(&tick)) {
            run.step().unwrap();
            let mut measured: Option<Measured> = None;
            for bytes in to_vehicle.receive(tick) {
                measured = client
                    .take(&bytes)
                    .map(|(measured, _)| measured)
                    .or(measured);
            }
            if client.is_held() {
                coupling.transfer().guard().end(HybridStatus::REQUESTED);
            }
            let displacement_m = run.state().damper_displacements_m()[damper];
            let command = coupling.tick(displacement_m, measured).command;
            let force_n = Some(f64::from(command.force_n));
            run.state_mut()
                .set_outside_force_n(damper, force_n)
                .unwrap();
            status = command.status;
            if !(status & HybridStatus::ENDING).is_empty() {
                acted.get_or_insert(tick.saturating_sub(BEGIN));
            }
            let frame = client.command(run.time_s(), command.command_m);
            to_rig.send(tick, &delays(&mut random), &frame.to_bytes());
        } else {
            to_vehicle.receive(tick);
        }
        for bytes in to_rig.receive(tick) {
            server.take(&bytes);
        }
        for _ in 0..fault.foreign * usize::from(is_faulty) {
            let mut bytes: Vec<u8> = (0..random.usize(0..60)).map(|_| random.u8(..)).collect();
            if random.bool() {
                // A start of another session, which must not take the rig over.
                bytes = RigClient::new(SESSION + 1, 1e-3)
                    .command(0.0, 0.05)
                    .to_bytes()
                    .into();
            }
            server.take(&bytes);
            assert!(client.take(&bytes).is_none());
        }
        let answer = server.tick();
        let command_m = server.command_m();
        fastest_m_per_s = fastest_m_per_s.max((command_m - last_m).abs() / case.step_s);
        last_m = command_m;
        if let Some(frame) = answer {
            to_vehicle.send(tick + 1, &delays(&mut random), &frame.to_bytes());
        }
    }
    assert!(
        fastest_m_per_s <= servo.limits.velocity_m_per_s * 1.0001,
        "{}: the actuator was asked for {fastest_m_per_s} m/s",
        fault.name
    );
    Outcome {
        status,
        acted,
        fastest_m_per_s,
        rig_is_held: server.is_held(),
        commands: server.counts(),
        lost_answers: client.counts().lost,
    }
}

#[test]
fn every_fault_of_the_wire_is_counted_and_survived() {
    let on_time: Wire = |_, _| vec![0];
    let fault = |name, wire, goes_on| Fault {
        name,
        wire,
        suspended: 0..0,
        foreign: 0,
        goes_on,
    };
    let faults = [
        fault("none", on_time, true),
        fault(
            "one datagram in ten lost",
            |random, _| {
                if random.u8(0..10) == 0 {
                    vec![]
                } else {
                    vec![0]
                }
            },
            true,
        ),
        fault("each datagram twice", |_, _| vec![0, 0], true),
        fault(
            "up to 2 ticks late, in any order",
            |random, _| vec![random.u64(0..3)],
            true,
        ),
        fault(
            "silent for 4 ticks in 100",
            |_, tick| if tick % 100 < 4 { vec![] } else { vec![0] },
            true,
        ),
        fault("network gone", |_, _| vec![], false),
        Fault {
            foreign: 3,
            ..fault("three foreign datagrams a tick", on_time, true)
        },
        Fault {
            suspended: BEGIN..BEGIN + 200,
            ..fault("host suspended for 200 ms", on_time, false)
        },
    ];
    let mut table = String::from(
        "| fault | guard | after, ticks | fastest, m/s | rig | commands: lost | late | repeated | foreign |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for fault in faults {
        let found = run(&fault);
        println!("{}: {found:?}", fault.name);
        let name = fault.name;
        assert_eq!(found.acted.is_none(), fault.goes_on, "{name}: {found:?}");
        assert_eq!(found.rig_is_held, !fault.goes_on, "{name}: {found:?}");
        assert!(
            found.lost_answers <= found.commands.lost + 250,
            "{name}: {found:?}"
        );
        let all = found.commands.fresh + found.commands.lost;
        assert!(fault.goes_on || all < TICKS as u32, "{name}: {found:?}");
        let seen: Vec<String> = found
            .status
            .iter_names()
            .map(|(name, _)| name.to_lowercase())
            .collect();
        let InboxCounts {
            lost,
            late,
            repeated,
            foreign,
            ..
        } = found.commands;
        let _ = writeln!(
            table,
            "| {name} | {} | {} | {:.3} | {} | {lost} | {late} | {repeated} | {foreign} |",
            if seen.is_empty() {
                "-".into()
            } else {
                seen.join(", ")
            },
            found
                .acted
                .map_or_else(|| "goes on".into(), |ticks| ticks.to_string()),
            found.fastest_m_per_s,
            if found.rig_is_held {
                "holds"
            } else {
                "follows"
            },
        );
    }
    document::compare_part(DOCUMENT, "network", &table);
}
