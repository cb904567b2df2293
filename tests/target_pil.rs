//! The firmware under QEMU: the host's bits through every fault, and the cost of a tick.

use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use dashpot::damper;
use dashpot::target::first_line;
use dashpot_core::link::{Counters, LossOfLink, Reals, Refusal, Request, Response, SafeOutput};
use dashpot_hil::excitation::Excitation;
use dashpot_hil::failure::Outcome;
use dashpot_hil::pil::{
    Client, FaultRates, FaultyLink, Link, LinkError, Patience, Qemu, Report, Session,
};
use xtask::processor::CORTEX_M7;
use xtask::tools::{ARM_GCC, QEMU, have, have_target};

/// Instructions of a 400 MHz core at one a cycle that a tick may take: 3 % at 1 kHz.
const BUDGET_1_KHZ: f64 = 0.03 * 400e6 / 1e3;
/// 25 % at 10 kHz.
const BUDGET_10_KHZ: f64 = 0.25 * 400e6 / 10e3;

/// The folder of the images; none, said loudly, where they cannot be built.
fn images() -> Option<PathBuf> {
    static IMAGES: OnceLock<Option<PathBuf>> = OnceLock::new();
    let build = || {
        let what = "the firmware under QEMU";
        if !have(&[QEMU, ARM_GCC], what) {
            return None;
        }
        let toolchain = have_target(CORTEX_M7.target, what)?;
        Some(xtask::firmware::build(&toolchain, &CORTEX_M7).unwrap())
    };
    IMAGES.get_or_init(build).clone()
}

/// Resets the target before the frames of these numbers.
struct ResetAt {
    link: Qemu,
    sent: u32,
    resets: &'static [u32],
}

impl Link for ResetAt {
    fn send(&mut self, bytes: &[u8]) -> Outcome<()> {
        self.sent += 1;
        if self.resets.contains(&self.sent) {
            self.link.reset_target()?;
        }
        self.link.send(bytes)
    }
    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Outcome<usize> {
        self.link.receive(buffer, timeout)
    }
    fn instructions_per_s(&self) -> Option<f64> {
        self.link.instructions_per_s()
    }
}

fn run(rates: &str, resets: &'static [u32], ticks: usize) -> Option<Report> {
    let image = images()?.join("dashpot-firmware");
    let rates: FaultRates = rates.parse().unwrap();
    let link = ResetAt {
        link: Qemu::start(&image).unwrap(),
        sent: 0,
        resets,
    };
    let link = FaultyLink::new(link, rates, 5).unwrap();
    let patience = Patience {
        timeout: Duration::from_millis(100),
        tries: 50,
    };
    let mut session = Session::open(Client::new(link, patience, 1)).unwrap();
    let ride = Excitation::Ride.displacements_m(1e-3);
    let mut ride = ride.into_iter().take(ticks);
    let damper = damper("in-service", &["mount.clearance_m=1e-3"]);
    let motion = || Ok(ride.next().map(|x| x as f32));
    let report = session.run(&damper.build(1e-3).unwrap(), motion, |_| ());
    Some(report.unwrap())
}

#[test]
fn the_target_has_the_hosts_bits() {
    let Some(report) = run("drop=0", &[], 2000) else {
        return;
    };
    assert_eq!(
        (report.ticks, report.mismatches, report.state_mismatches),
        (2000, 0, 0)
    );
    assert_eq!(report.target.dampers, 12);
    let instructions = report.instructions.unwrap();
    println!("{instructions:?}");
    assert!(instructions.mean > 12.0 * 50.0 && instructions.max < BUDGET_10_KHZ);
}

#[test]
fn the_target_has_the_hosts_bits_through_every_fault() {
    let faults = "drop=0.01,corrupt=0.02,delay=0.01,duplicate=0.02,reorder=0.01";
    // While it steps, while it is loaded again after that, and late in the run.
    let Some(report) = run(faults, &[500, 700, 1300], 600) else {
        return;
    };
    assert_eq!(
        (report.ticks, report.mismatches, report.state_mismatches),
        (600, 0, 0)
    );
    assert!(report.recoveries >= 2, "{report:?}");
    assert!(report.link_faults.repeated_requests > 0);
}

#[test]
fn the_free_running_target_loses_the_link_and_outputs_zero() {
    let Some(images) = images() else {
        return;
    };
    let link = Qemu::start(&images.join("dashpot-firmware")).unwrap();
    let patience = Patience {
        timeout: Duration::from_secs(2),
        tries: 10,
    };
    let mut client = Client::new(link, patience, 9);
    client.hello().unwrap();
    let after_ticks = 200;
    let ramp = SafeOutput::RampToZero { ticks: 10 };
    let loss = LossOfLink {
        after_ticks,
        output: ramp,
    };
    client.request(&Request::LossOfLink(loss)).unwrap();
    let all = |x: f32| -> Reals { (0..12).map(|_| x).collect() };
    let run = Request::Run {
        displacements_m: all(0.0),
    };
    client.request(&run).unwrap();
    // Moved on at every answer, so forces come; the tick is the target's own.
    let (mut tick, mut x, mut forces_n) = (0, 0.0, Reals::new());
    while tick < 100 {
        x += 0.2e-3;
        let displace = Request::Displace {
            displacements_m: all(x),
        };
        let Ok(Response::Forces(forces)) = client.request(&displace) else {
            panic!("no forces after tick {tick}");
        };
        assert!(forces.tick >= tick);
        (tick, forces_n) = (forces.tick, forces.forces_n);
    }
    assert!(forces_n.iter().any(|force| *force > 100.0), "{forces_n:?}");
    // Counters are no displacement: the link goes.
    let mut counters = Counters::default();
    let begin = Instant::now();
    while counters.link_losses == 0 && begin.elapsed() < Duration::from_secs(60) {
        let Ok(Response::Counters(now)) = client.request(&Request::Counters) else {
            panic!("no counters");
        };
        counters = now;
    }
    assert_eq!((counters.link_losses, counters.overruns), (1, 0));
    let displace = Request::Displace {
        displacements_m: all(x),
    };
    let refused = client.request(&displace);
    assert_eq!(refused, Err(LinkError::Refused(Refusal::LinkLost)));
    let Ok(Response::Forces(forces)) = client.request(&run) else {
        panic!("no forces");
    };
    assert_eq!((forces.tick, &forces.forces_n), (0, &all(0.0)));
    assert_eq!(client.request(&Request::Stop), Ok(Response::Done));
}

#[test]
fn a_tick_with_everything_the_link_takes_keeps_the_budget() {
    let Some(images) = images() else {
        return;
    };
    let printed = first_line(&images.join("link-cost"), &CORTEX_M7, 0, &[]);
    let printed: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let number = |key: &str| printed[key].as_f64().unwrap();
    let requests = number("requests");
    assert_eq!(number("accepted"), requests + 1.0, "hello and every step");
    let instructions_per_clock_tick = 1e9 / number("clock_hz");
    let mean = number("clock_ticks") * instructions_per_clock_tick / requests;
    let most = number("most_clock_ticks") * instructions_per_clock_tick;
    println!("a tick of 12 dampers with its link: {mean:.0} instructions, {most:.0} at most");
    assert!(most <= BUDGET_1_KHZ, "{most}");
    assert!(most <= BUDGET_10_KHZ, "{most}");
}
