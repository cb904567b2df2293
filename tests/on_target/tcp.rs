//! The link over TCP on an emulated Cortex-M7: answers have the host's bits, and a tick with the network stack keeps
//! its budget.

use std::io::ErrorKind;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::time::Duration;

use dashpot::in_turn::images;
use dashpot::target::{Emulator, first_line};
use dashpot::{damper, document};
use dashpot_core::link::{Clock, Device};
use dashpot_experiment::digest::Digest;
use dashpot_experiment::network::{hello_frame, step_frame};
use dashpot_host_link::{Client, LinkError, Pace, RetryLimits, Session, SessionError, Tcp};
use dashpot_testbench::excitation::Excitation;
use serde_json::Value;
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;

const DOCUMENT: &str = "docs/board.md";
/// Instructions allowed for a tick on a 400 MHz core at one per cycle: 8 % at 1 kHz.
const MAX_TICK: f64 = 0.08 * 400e6 / 1e3;
/// Bytes in a second on a line of 100 Mbit/s.
const LINE_BYTES_PER_S: f64 = 100e6 / 8.0;

/// Digest of what the bank of the firmware answers to the steps of both clients of the image.
fn expected_digest(requests: u32, clock_hz: u32) -> String {
    let [in_service, vertical, lateral] = ["in-service", "reduced-vertical", "reduced-lateral"]
        .map(|name| damper(name, &[]).build(1e-3).unwrap());
    let bank = [&in_service, &vertical, &lateral]
        .map(|damper| [damper; 4])
        .concat();
    let mut device = Box::new(Device::<12>::new());
    let bank = bank.try_into().unwrap();
    device.start(&bank, Clock::new(|| 0, clock_hz)).unwrap();
    let mut digest = Digest::default();
    let mut answer = |frame: &[u8]| {
        let answered = frame.iter().filter(|byte| device.receive(**byte)).count();
        assert_eq!(answered, 1);
        device.response().to_vec()
    };
    for client in 0..2 {
        let session = client as u16 + 1;
        answer(hello_frame(session).bytes());
        for number in 1..=requests {
            let step = step_frame(session, number, client * requests + number);
            digest.add(answer(step.bytes()));
        }
    }
    format!("{:016x}", digest.value())
}

/// The folder of the images and the compiler that made them; `None` if they do not have a network stack.
fn images_with_tcp() -> Option<(PathBuf, TargetToolchain)> {
    let images = images()?;
    let toolchain = TargetToolchain::find(CORTEX_M7.target).unwrap();
    if toolchain != TargetToolchain::Installed {
        println!("skipped: images with a network stack need the target of rustup");
        return None;
    }
    Some((images, toolchain))
}

/// Opens a session with the image, which refuses a host in the moment before it listens, also between two hosts. Each
/// refusal comes from the image, so every try gives it time.
fn open(address: &str, number: u16) -> Session<Tcp> {
    // TCP loses nothing, so nothing is repeated.
    let limits = RetryLimits {
        timeout: Duration::from_secs(60),
        ..RetryLimits::default()
    };
    for _ in 0..100 {
        let link = Tcp::connect(address).unwrap();
        match Session::open(Client::new(link, limits, number)) {
            // QEMU closes the connection; what the host sees of that depends on what it has sent.
            Err(SessionError::Link(LinkError::Line { source, .. }))
                if [
                    ErrorKind::ConnectionReset,
                    ErrorKind::BrokenPipe,
                    ErrorKind::Other,
                ]
                .contains(&source.kind()) => {}
            opened => return opened.unwrap(),
        }
    }
    panic!("the image never listened");
}

/// Starts the image behind a port of this machine; returns both. The port is free when it is chosen; if another program
/// takes it before QEMU does, QEMU ends.
fn served(image: &Path) -> (Emulator, String) {
    for _ in 0..10 {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        drop(listener);
        let network = format!("user,model=lan9118,hostfwd=tcp:{address}-:5555");
        let mut board = Emulator::start(image, &CORTEX_M7, 0, &["-nic", &network]);
        let line = board.line();
        if !line.is_empty() {
            assert_eq!(line, "listens\n");
            return (board, address);
        }
    }
    panic!("QEMU never started");
}

/// The emulator has an Ethernet controller and passes connections to a port of this machine on to the image.
#[test]
fn a_board_on_the_network_has_the_hosts_bits() {
    let Some((images, _)) = images_with_tcp() else {
        return;
    };
    let (mut board, address) = served(&images.join("tcp-served"));
    // One host after the other.
    for (session, ticks) in [(1, 300), (2, 50)] {
        let mut session = open(&address, 10 * session);
        let ride = Excitation::Ride.displacements_m(1e-3);
        let mut ride = ride.into_iter().take(ticks);
        let motion = || Ok::<_, SessionError>(ride.next().map(|x| x as f32));
        let dampers = [damper("in-service", &[]).build(1e-3).unwrap()];
        let report = session.run(&dampers, motion, &mut Pace::default(), |_| Ok(()));
        let report = report.unwrap();
        assert_eq!(
            (report.ticks, report.mismatches, report.state_mismatches),
            (ticks as u32, 0, 0)
        );
        assert_eq!((report.target.dampers, report.recoveries), (12, 0));
        drop(session);
        assert_eq!(board.line(), "BrokenPipe\n");
    }
}

#[test]
fn a_tick_over_tcp_has_the_hosts_bits_and_keeps_the_budget() {
    let Some((images, toolchain)) = images_with_tcp() else {
        return;
    };
    let line = first_line(&images.join("tcp-cost"), &CORTEX_M7, 0, &[]);
    let printed: Value =
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("`{line}`: {error}"));
    let number = |value: &Value| value.as_f64().unwrap();
    let (requests, clock_hz) = (number(&printed["requests"]), number(&printed["clock_hz"]));
    let expected = expected_digest(requests as u32, clock_hz as u32);
    assert_eq!(printed["digest"], expected);

    let instructions = |ticks: &Value| number(ticks) * 1e9 / clock_hz;
    let hosts = ["at_once", "with_request"].map(|name| &printed[name]);
    for (host, acknowledgements) in hosts.into_iter().zip([1.0, 0.0]) {
        assert_eq!(number(&host["answers"]), requests);
        let frames = [0, 1].map(|way| number(&host["frames"][way]) / requests);
        assert_eq!(frames, [1.0 + acknowledgements, 1.0]);
        let most = instructions(&host["most"]);
        assert!(most <= MAX_TICK, "{most}");
    }
    let row = |words: &str, cell: &dyn Fn(&Value) -> String| {
        format!("| {words} | {} | {} |\n", cell(hosts[0]), cell(hosts[1]))
    };
    let bytes = |host: &Value, way: usize| number(&host["line_bytes"][way]) / requests;
    let compiler = toolchain.version().unwrap();
    let table = format!(
        "| {compiler} | the host acknowledges at once | with its next request |\n|---|---|---|\n{}{}{}{}{}{}\n\
         A tick without a request takes {:.0} instructions, a broadcast for another computer {:.0}, and the refusal of \
         a connection\nto another port {:.0}.\n",
        row("instructions in a tick, mean", &|host| {
            format!("{:.0}", instructions(&host["total"]) / requests)
        }),
        row("instructions in a tick, most", &|host| {
            format!("{:.0}", instructions(&host["most"]))
        }),
        row("share of 400 MHz at 1 kHz, most", &|host| {
            format!("{:.1} %", 100.0 * instructions(&host["most"]) * 1e3 / 400e6)
        }),
        row("frames in a tick, to the board and from it", &|host| {
            let [to, from] = [0, 1].map(|way| number(&host["frames"][way]) / requests);
            format!("{to}, {from}")
        }),
        row("bytes in a tick, to the board and from it", &|host| {
            format!("{:.0}, {:.0}", bytes(host, 0), bytes(host, 1))
        }),
        row("time of these bytes at 100 Mbit/s", &|host| {
            let both = bytes(host, 0) + bytes(host, 1);
            format!("{:.0} us", 1e6 * both / LINE_BYTES_PER_S)
        }),
        instructions(&printed["idle"]),
        instructions(&printed["foreign_arp"]),
        instructions(&printed["closed_port"]),
    );
    // Another compiler must keep the budget, but its figures may differ.
    if document::blessing() || document::part(DOCUMENT, "tcp").contains(&compiler) {
        document::compare_part(DOCUMENT, "tcp", &table);
    }
}
