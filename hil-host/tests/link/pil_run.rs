//! Runs the host's end of the link with the firmware's device in the test process, under every kind of fault.

use std::time::Duration;

use dashpot_core::Status;
use dashpot_core::link::{
    FrameReader, Header, PROTOCOL, REQUEST_BYTES, Refusal, Request, Response, ResponseFrame,
};
use dashpot_host_link::{
    Client, Desk, Event, FaultCounts, FaultRates, FaultyLink, Link, LinkError, Pace, Report,
    Session, SessionError, Tcp,
};
#[cfg(all(unix, feature = "serial"))]
use {crate::pil_common::serve, dashpot_host_link::Serial, std::path::Path};

use crate::pil_common::{RETRY_LIMITS, altered, built, desk, motion, serve_tcp};

fn drive(rates: &str, seed: u64) -> (Report, FaultCounts) {
    let rates: FaultRates = rates.parse().unwrap();
    let link = FaultyLink::new(desk(), rates, seed).unwrap();
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 40)).unwrap();
    let report = session
        .run(
            &[built("paper")],
            motion(1000),
            &mut Pace::default(),
            |_| Ok(()),
        )
        .unwrap_or_else(|failure| panic!("{rates:?}: {failure}"));
    (report, session.link().injected_faults())
}

#[test]
fn without_faults_every_force_has_the_hosts_bits() {
    let (report, made) = drive("drop=0", 1);
    assert_eq!(
        (report.ticks, report.mismatches, report.state_mismatches),
        (1000, 0, 0)
    );
    assert_eq!((report.recoveries, made), (0, FaultCounts::default()));
    assert_eq!(report.link_faults, Default::default());
    assert_eq!(report.target_counters.corrupt, 0);
    // The target accepted two hellos, a restore, one load per damper, the steps, and a save.
    assert_eq!(report.target_counters.accepted, 3 + 3 + 1000 + 1);
    assert_eq!(report.round_trip.count, 1000);
}

#[test]
fn after_any_fault_the_run_continues_to_the_bit() {
    for (kind, count) in [
        ("drop", (|c| c.dropped) as fn(&FaultCounts) -> u64),
        ("corrupt", |c| c.corrupted),
        ("delay", |c| c.delayed),
        ("duplicate", |c| c.duplicated),
        ("reorder", |c| c.reordered),
        ("reset", |c| c.resets),
    ] {
        let rate = if kind == "reset" { 0.005 } else { 0.1 };
        let (report, made) = drive(&format!("{kind}={rate}"), 3);
        assert!(count(&made) > 4, "{kind}: {made:?}");
        assert_eq!((report.ticks, report.mismatches), (1000, 0), "{kind}");
        assert_eq!(report.state_mismatches, 0, "{kind}");
        if kind == "reset" {
            assert!(report.recoveries > 0);
        } else {
            assert_eq!(report.recoveries, 0, "{kind}");
            // Each tick was stepped exactly once, however often it was sent.
            assert!(report.target_counters.accepted >= 1000);
        }
    }
}

#[test]
fn every_tick_reports_its_events() {
    let rates: FaultRates =
        "drop=0.02,corrupt=0.02,delay=0.02,duplicate=0.02,reorder=0.02,reset=0.002"
            .parse()
            .unwrap();
    let link = FaultyLink::new(desk(), rates, 2).unwrap();
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 40)).unwrap();
    let mut reported: Vec<Vec<Event>> = Vec::new();
    let report = session
        .run(
            &[built("paper")],
            motion(1000),
            &mut Pace::default(),
            |record| {
                reported.push(record.events.to_vec());
                Ok(())
            },
        )
        .unwrap();
    let made = session.link().injected_faults();
    let ticks_with = |event| {
        reported
            .iter()
            .filter(|events| events.contains(&event))
            .count() as u64
    };
    for (event, most) in [
        (Event::Drop, made.dropped),
        (Event::Corrupt, made.corrupted),
        (Event::Delay, made.delayed),
        (Event::Duplicate, made.duplicated),
        (Event::Reorder, made.reordered),
        (Event::Reset, made.resets),
        (Event::Repeat, report.link_faults.repeated_requests),
        (Event::Recovery, report.recoveries),
    ] {
        let ticks = ticks_with(event);
        assert!(ticks > 0 && ticks <= most, "{event}: {ticks} of {most}");
    }
    assert_eq!(ticks_with(Event::Late) + ticks_with(Event::Mismatch), 0);
    assert!(reported.iter().any(Vec::is_empty));
}

#[test]
fn all_faults_together_are_survived_and_repeatable() {
    let all = "drop=0.03,corrupt=0.03,delay=0.03,duplicate=0.03,reorder=0.03,reset=0.001";
    for seed in 1..6 {
        let (report, made) = drive(all, seed);
        assert_eq!((report.ticks, report.mismatches), (1000, 0), "seed {seed}");
        assert_eq!(report.state_mismatches, 0);
        let (again, made_again) = drive(all, seed);
        assert_eq!(made, made_again);
        assert_eq!(report.link_faults, again.link_faults);
        assert_eq!(report.target_counters, again.target_counters);
    }
    assert_ne!(drive(all, 1).1, drive(all, 2).1);
}

fn report_of(link: impl Link) -> Result<Report, SessionError> {
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 40))?;
    let dampers = [built("paper")];
    session.run(&dampers, motion(100), &mut Pace::default(), |_| Ok(()))
}

#[test]
fn one_wrong_bit_of_one_force_is_a_mismatch() {
    let report = report_of(altered(
        |header, mut response, frame: &mut ResponseFrame| {
            if let Response::Forces(forces) = &mut response
                && forces.tick == 42
            {
                forces.forces_n[2] = f32::from_bits(forces.forces_n[2].to_bits() ^ 1);
            }
            frame.write(&(header, response))
        },
    ))
    .unwrap();
    assert_eq!(report.mismatches, 1);
    let first = report.first_mismatch.unwrap();
    assert_eq!((first.tick, first.damper), (42, 2));
    assert_eq!(first.target_status & Status::INPUT_HELD.bits(), 0);
}

#[test]
fn a_target_that_cannot_be_compared_is_refused() {
    let version = report_of(altered(
        |header, mut response, frame: &mut ResponseFrame| {
            if let Response::Welcome(welcome) = &mut response {
                welcome.core_version = "9.9.9";
            }
            frame.write(&(header, response))
        },
    ));
    assert!(
        version
            .unwrap_err()
            .to_string()
            .contains("dashpot-core 9.9.9")
    );
    let protocol = report_of(altered(|header, _, frame: &mut ResponseFrame| {
        frame.write(&(header, Response::Refused(Refusal::Protocol(PROTOCOL + 1))))
    }));
    let message = protocol.unwrap_err().to_string();
    assert!(
        message.contains("version 4 of the link protocol, but this host speaks version 3"),
        "{message}"
    );
    let step = report_of(altered(
        |header, mut response, frame: &mut ResponseFrame| {
            if let Response::Welcome(welcome) = &mut response {
                welcome.step_s = 5e-4;
            }
            frame.write(&(header, response))
        },
    ));
    let message = step.unwrap_err().to_string();
    assert!(
        message.contains("0.001 s, but the step of the target is 0.0005 s"),
        "{message}"
    );
}

#[test]
fn a_target_that_falls_silent_stops_the_run_with_the_reason() {
    // 49 answers: two to hello, three to load, one to restore, the rest to steps.
    let last = 49 - 2 - 3 - 1;
    let mut left = 50;
    let silent = report_of(altered(
        move |header, response, frame: &mut ResponseFrame| {
            left -= 1;
            left > 0 && frame.write(&(header, response))
        },
    ));
    let message = silent.unwrap_err().to_string();
    let start = format!("after tick {last}: no answer from the target to 30 tries within ");
    assert!(message.starts_with(&start), "{message}");
    assert!(
        message.ends_with(" s; the first try waited 300000 ms"),
        "{message}"
    );
}

#[test]
fn a_target_reset_again_and_again_stops_the_run_with_the_reason() {
    struct Forgetful(Desk<3>);
    impl Link for Forgetful {
        fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
            let mut reader = FrameReader::<REQUEST_BYTES>::new();
            let mut step = false;
            for byte in bytes {
                if let Some(Ok(message)) = reader.push(*byte) {
                    let (_, request): (Header, Request<'_>) =
                        postcard::from_bytes(message.bytes).unwrap();
                    step = matches!(request, Request::Step { .. });
                }
            }
            if step {
                self.0.reset_target()?;
            }
            self.0.send(bytes)
        }
        fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
            self.0.receive(buffer, timeout)
        }
    }
    let message = report_of(Forgetful(desk())).unwrap_err().to_string();
    assert_eq!(
        message,
        "after tick 0: the target was lost 10 times in a row"
    );
}

#[test]
fn a_tcp_port_is_a_link() {
    let address = serve_tcp(|| Box::new(desk()));
    let report = report_of(Tcp::connect(&address).unwrap()).unwrap();
    assert_eq!((report.ticks, report.mismatches), (100, 0));
}

#[cfg(all(unix, feature = "serial"))]
#[test]
fn a_serial_device_is_a_link() {
    use serialport::SerialPort;
    let (mut target, host) = serialport::TTYPort::pair().unwrap();
    target.set_timeout(Duration::from_millis(100)).unwrap();
    let device = host.name().unwrap();
    let line = Serial::open(Path::new(&device), 115_200).unwrap();
    serve(target, || Box::new(desk()));
    let report = report_of(line).unwrap();
    assert_eq!((report.ticks, report.mismatches), (100, 0));
    drop(host);
}

#[test]
fn faults_are_checked() {
    for (text, reason) in [
        ("drop", "`drop` is not KIND=PROBABILITY"),
        (
            "lose=0.1",
            "`lose` is not a fault; allowed: drop, corrupt, delay, duplicate, reorder, reset",
        ),
        ("drop=0.6", "drop: `0.6` is not within 0 to 0.5"),
        ("drop=nan", "drop: `nan` is not within 0 to 0.5"),
        (
            "drop=0.5,delay=0.4,corrupt=0.2",
            "the probabilities add up to more than 1",
        ),
    ] {
        assert_eq!(text.parse::<FaultRates>().unwrap_err(), reason);
    }
    let rates = "reset=0.1".parse().unwrap();
    let refused = FaultyLink::new(altered(|_, _, _: &mut ResponseFrame| true), rates, 1);
    assert!(
        refused
            .err()
            .unwrap()
            .to_string()
            .contains("cannot reset its target")
    );
}
