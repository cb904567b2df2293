//! The firmware under QEMU: the host's bits through every fault, and the cost of a tick.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use dashpot::damper;
use dashpot::target::first_line;
use dashpot_core::link::{Counters, LossOfLink, Reals, Refusal, Request, Response, SafeOutput};
use dashpot_hil::excitation::Excitation;
use dashpot_hil::failure::Outcome;
use dashpot_hil::pil::{
    Client, FaultRates, FaultyLink, Link, LinkError, Pace, Patience, Qemu, Report, Session,
};
use xtask::processor::CORTEX_M7;
use xtask::tools::{ARM_GCC, QEMU, have, have_target};

/// Instructions of a 400 MHz core at one a cycle that a tick may take: 3 % at 1 kHz.
const BUDGET_1_KHZ: f64 = 0.03 * 400e6 / 1e3;
/// 25 % at 10 kHz.
const BUDGET_10_KHZ: f64 = 0.25 * 400e6 / 10e3;

/// The link under the client never lets it wait.
const PATIENCE: Patience = Patience {
    timeout: Duration::ZERO,
    tries: 50,
};
/// Of a target that will never answer; one that does ends the wait.
const STUCK: Duration = Duration::from_secs(300);
/// Of a target that counts its own ticks: a tick has time for a hundred.
const MOST_ANSWERS: u32 = 1_000_000;

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

/// An emulator that is asked and answers in turn, so that a run is the same on a fast machine and a slow
/// one: every whole frame has one answer, and sending waits for all of them.
struct InTurn {
    emulator: Qemu,
    /// Within a frame to the target.
    partial: bool,
    answers: VecDeque<u8>,
    sent: u32,
    /// Resets the target before the frames of these numbers.
    resets: &'static [u32],
}

impl InTurn {
    fn start(image: &Path, resets: &'static [u32]) -> Self {
        Self {
            emulator: Qemu::start(image).unwrap(),
            partial: false,
            answers: VecDeque::new(),
            sent: 0,
            resets,
        }
    }

    /// Frames that end within `bytes`; two zeros in a row hold none.
    fn frames(&mut self, bytes: &[u8]) -> usize {
        let ends = bytes.iter().filter(|byte| {
            let ends = **byte == 0 && self.partial;
            self.partial = **byte != 0;
            ends
        });
        ends.count()
    }
}

impl Link for InTurn {
    fn send(&mut self, bytes: &[u8]) -> Outcome<()> {
        self.sent += 1;
        if self.resets.contains(&self.sent) {
            self.emulator.reset_target()?;
            self.partial = false;
        }
        self.emulator.send(bytes)?;
        let mut expected = self.frames(bytes);
        while expected > 0 {
            let mut buffer = [0; 1024];
            let count = self.emulator.receive(&mut buffer, STUCK)?;
            assert!(count > 0, "no answer in {STUCK:?}: the target is stuck");
            let received = &buffer[..count];
            expected -= received.iter().filter(|byte| **byte == 0).count();
            self.answers.extend(received);
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], _: Duration) -> Outcome<usize> {
        let count = buffer.len().min(self.answers.len());
        for (place, byte) in buffer.iter_mut().zip(self.answers.drain(..count)) {
            *place = byte;
        }
        Ok(count)
    }

    fn instructions_per_s(&self) -> Option<f64> {
        self.emulator.instructions_per_s()
    }
}

fn run(rates: &str, resets: &'static [u32], ticks: usize) -> Option<Report> {
    let image = images()?.join("dashpot-firmware");
    let rates: FaultRates = rates.parse().unwrap();
    let link = FaultyLink::new(InTurn::start(&image, resets), rates, 5).unwrap();
    let mut session = Session::open(Client::new(link, PATIENCE, 1)).unwrap();
    let ride = Excitation::Ride.displacements_m(1e-3);
    let mut ride = ride.into_iter().take(ticks);
    let damper = damper("in-service", &["mount.clearance_m=1e-3"]);
    let motion = || Ok(ride.next().map(|x| x as f32));
    let dampers = [damper.build(1e-3).unwrap()];
    let report = session.run(&dampers, motion, &mut Pace::default(), |_| Ok(()));
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
    let link = InTurn::start(&images.join("dashpot-firmware"), &[]);
    let mut client = Client::new(link, PATIENCE, 9);
    client.hello().unwrap();
    let lose_after = |after_ticks| {
        Request::LossOfLink(LossOfLink {
            after_ticks,
            output: SafeOutput::RampToZero { ticks: 10 },
        })
    };
    // However slow this host is, the link holds for now.
    client.request(&lose_after(u32::MAX)).unwrap();
    let all = |x: f32| -> Reals { (0..12).map(|_| x).collect() };
    let run = Request::Run {
        displacements_m: all(0.0),
    };
    client.request(&run).unwrap();
    // Moved to and fro at every answer, so forces come; the tick is the target's own.
    let (mut tick, mut x, mut moved) = (0, 0.0, false);
    for answer in 0..MOST_ANSWERS {
        if tick >= 100 && moved {
            break;
        }
        x += if answer % 100 < 50 { 0.2e-3 } else { -0.2e-3 };
        let displace = Request::Displace {
            displacements_m: all(x),
        };
        let Ok(Response::Forces(forces)) = client.request(&displace) else {
            panic!("no forces after tick {tick}");
        };
        assert!(forces.tick >= tick);
        tick = forces.tick;
        moved |= forces.forces_n.iter().any(|force| *force > 100.0);
    }
    assert!(tick >= 100 && moved, "{tick}");
    // Counters are no displacement: the link goes.
    client.request(&lose_after(200)).unwrap();
    let mut counters = Counters::default();
    for _ in 0..MOST_ANSWERS {
        let Ok(Response::Counters(now)) = client.request(&Request::Counters) else {
            panic!("no counters");
        };
        counters = now;
        if counters.link_losses > 0 {
            break;
        }
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
