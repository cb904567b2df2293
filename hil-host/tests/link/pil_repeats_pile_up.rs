//! Regression: on a slow line or a busy machine, `dashpot pil` gave up on a target that answered every request. The
//! host repeated requests before their answers could arrive. The target answered each repeat, so each request had to
//! wait for the answers to more repeats than the one before.

use std::collections::VecDeque;
use std::net::{Ipv4Addr, TcpListener};
use std::time::{Duration, Instant};

use dashpot_core::link::{Clock, Device, Line, Outputs};
use dashpot_host_link::{
    Client, Link, LinkError, Pace, Report, RetryLimits, Session, SessionError,
};

use crate::common::{dashpot, error_of};
use crate::pil_common::{built, motion};

/// The firmware's device behind a slow line, on simulated time: it takes one byte per `byte_time`, like an emulator on
/// a busy machine, and its answers travel for `latency`.
struct SlowLine {
    device: Box<Device<3, 3>>,
    start: Instant,
    elapsed: Duration,
    byte_time: Duration,
    latency: Duration,
    to_device: VecDeque<u8>,
    to_host: VecDeque<(Duration, u8)>,
}

/// State of the line during one pass of the device's loop.
struct Pass<'a> {
    byte: Option<u8>,
    arrives: Duration,
    to_host: &'a mut VecDeque<(Duration, u8)>,
}

impl Line for Pass<'_> {
    fn receive(&mut self) -> Option<u8> {
        self.byte.take()
    }

    fn send(&mut self, byte: u8) -> bool {
        self.to_host.push_back((self.arrives, byte));
        true
    }
}

struct NoActuators;

impl Outputs<3> for NoActuators {
    fn drive(&mut self, _: &[f32; 3]) {}
}

impl SlowLine {
    fn new(byte_time: Duration, latency: Duration) -> Self {
        let bank = ["reduced-vertical", "in-service", "reduced-lateral"].map(built);
        let clock = Clock::new(|| 0, 1_000_000);
        let mut device = Box::new(Device::new());
        device.start(&bank.each_ref(), clock).unwrap();
        Self {
            device,
            start: Instant::now(),
            elapsed: Duration::ZERO,
            byte_time,
            latency,
            to_device: VecDeque::new(),
            to_host: VecDeque::new(),
        }
    }

    /// Runs one pass of the firmware's loop.
    fn pass(&mut self) {
        self.elapsed += self.byte_time;
        // While the device sends, a byte waits on the line; while it loads a damper, it reads no bytes.
        let takes = !self.device.is_sending() && !self.device.is_busy();
        let byte = takes.then(|| self.to_device.pop_front()).flatten();
        let mut line = Pass {
            byte,
            arrives: self.elapsed + self.latency,
            to_host: &mut self.to_host,
        };
        self.device.poll(0, &mut line, &mut NoActuators);
    }
}

impl Link for SlowLine {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.to_device.extend(bytes);
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        let end = self.elapsed + timeout;
        loop {
            let arrived = |(arrives, _): &&(Duration, u8)| *arrives <= self.elapsed;
            let count = self.to_host.iter().take_while(arrived).count();
            let count = count.min(buffer.len());
            for (slot, (_, byte)) in buffer.iter_mut().zip(self.to_host.drain(..count)) {
                *slot = byte;
            }
            if count > 0 || self.elapsed >= end {
                return Ok(count);
            }
            self.pass();
        }
    }

    fn now(&self) -> Instant {
        self.start + self.elapsed
    }
}

/// Drives the bank for 50 ticks with the limits of the command.
fn drive(byte_time: Duration, latency: Duration) -> Result<(Report, Duration), SessionError> {
    let line = SlowLine::new(byte_time, latency);
    let mut session = Session::open(Client::new(line, RetryLimits::default(), 40))?;
    let dampers = [built("paper")];
    let report = session.run(&dampers, motion(50), &mut Pace::default(), |_| {
        Ok::<(), SessionError>(())
    })?;
    Ok((report, session.link().elapsed))
}

#[test]
fn a_slow_target_is_waited_for_and_repeats_do_not_pile_up() {
    for (byte_us, latency_ms, most_repeats) in [
        // The first timeout allows for 100 us per byte. The line is faster first, then slower.
        (10, 0, 0),
        (90, 0, 0),
        (200, 0, 6),
        (400, 0, 12),
        (800, 0, 20),
        // The latency is longer than the first timeout of 200 ms.
        (10, 505, 40),
        (90, 505, 40),
        (10, 1500, 60),
        (200, 1500, 60),
    ] {
        let (byte, latency) = (
            Duration::from_micros(byte_us),
            Duration::from_millis(latency_ms),
        );
        let (report, took) = drive(byte, latency)
            .unwrap_or_else(|error| panic!("{byte_us} us, {latency_ms} ms: {error}"));
        assert_eq!((report.ticks, report.mismatches), (50, 0));
        assert_eq!((report.state_mismatches, report.recoveries), (0, 0));
        let repeats = report.link_faults.repeated_requests;
        let faults = report.link_faults;
        assert!(
            repeats <= most_repeats,
            "{byte_us} us, {latency_ms} ms: {faults:?} in {took:?}"
        );
    }
}

/// The error contains the remedy: nothing answers on the port.
#[test]
fn a_silent_target_names_the_options() {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let link = format!("tcp:{}", listener.local_addr().unwrap());
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("in.csv"),
        "time_s,displacement_m\n0,0\n0.01,0.001\n",
    )
    .unwrap();
    let line = ["pil", "--link", &link, "--input", "in.csv"];
    let limits = ["--timeout-ms", "1", "--tries", "3"];
    let error = error_of(&dashpot(&[&line[..], &limits].concat(), folder.path()).code(1));
    assert!(
        error.contains("no answer from the target to 3 tries"),
        "{error}"
    );
    assert!(
        error.contains("use a longer --timeout-ms or more --tries"),
        "{error}"
    );
}
