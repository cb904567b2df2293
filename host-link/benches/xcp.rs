//! Measurement at 1 kHz in real time by XCP: samples, losses, and the time until a master has a sample.
//!
//! `cargo bench -p dashpot-host-link --bench xcp`, with seconds after `--` for longer runs. The figures of docs/xcp.md.

use std::io::{Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use dashpot_core::xcp::ethernet::{header, split};
use dashpot_host_link::a2l::{Description, Measurement};
use dashpot_host_link::xcp::{Fixed, Image, Pacing, Server};
use dashpot_realtime::options::RealtimeOptions;
use dashpot_realtime::pacing::Pacer;
use dashpot_realtime::timing::span;

/// Signals of the locomotive, about.
const SIGNALS: usize = 200;
const STEP_S: f64 = 1e-3;

/// Sends and receives messages.
enum Socket {
    Udp(UdpSocket),
    Tcp(TcpStream),
}

impl Socket {
    fn new(is_udp: bool, port: u16) -> Self {
        if is_udp {
            let socket = UdpSocket::bind("127.0.0.1:0").expect("a socket");
            socket.connect(("127.0.0.1", port)).expect("a server");
            return Self::Udp(socket);
        }
        Self::Tcp(TcpStream::connect(("127.0.0.1", port)).expect("a server"))
    }

    fn send(&mut self, packet: &[u8]) {
        let message = [&header(packet.len() as u16, 0)[..], packet].concat();
        match self {
            Self::Udp(socket) => socket.send(&message).map(drop),
            Self::Tcp(stream) => stream.write_all(&message),
        }
        .expect("the server reads");
    }

    /// Adds what arrives to `bytes`.
    fn receive(&mut self, bytes: &mut Vec<u8>) {
        let mut part = [0; 65536];
        let length = match self {
            Self::Udp(socket) => socket.recv(&mut part),
            Self::Tcp(stream) => stream.read(&mut part),
        };
        bytes.extend_from_slice(&part[..length.expect("the server writes")]);
    }
}

/// Packets that measure all signals in each tick: entries of 200 bytes, four in a packet.
fn configuration() -> Vec<Vec<u8>> {
    let mut packets: Vec<Vec<u8>> = vec![
        vec![0xFF, 0],
        vec![0xD6],
        vec![0xD5, 0, 1, 0],
        vec![0xD4, 0, 0, 0, 2],
        vec![0xD3, 0, 0, 0, 0, 4],
        vec![0xD3, 0, 0, 0, 1, 4],
    ];
    for entry in 0..8_u32 {
        packets.push(vec![0xE2, 0, 0, 0, entry as u8 / 4, entry as u8 % 4]);
        let address = (0x1000_0000 + 200 * entry).to_le_bytes();
        packets.push([&[0xE1, 0xFF, 200, 0][..], &address].concat());
    }
    packets.push(vec![0xE0, 0x10, 0, 0, 0, 0, 1, 0]);
    packets.push(vec![0xDE, 1, 0, 0]);
    packets
}

/// What a master got.
struct Got {
    samples: u64,
    lost_messages: u64,
    delays_us: Vec<f64>,
}

/// Measures until the session ends; `sent` has the time of each tick.
fn measure(mut socket: Socket, port_ready: &dyn Fn(), sent: &Receiver<Instant>) -> Got {
    let mut bytes = Vec::new();
    let mut counter = None;
    let mut got = Got {
        samples: 0,
        lost_messages: 0,
        delays_us: Vec::new(),
    };
    let mut requests = configuration().into_iter();
    socket.send(&requests.next().expect("CONNECT"));
    let mut last = Instant::now();
    loop {
        socket.receive(&mut bytes);
        let now = Instant::now();
        let mut rest = &bytes[..];
        while let Some((packet, next)) = split(rest) {
            let number = u16::from_le_bytes([rest[2], rest[3]]);
            if let Some(before) = counter.replace(number) {
                got.lost_messages += u64::from(number.wrapping_sub(before).wrapping_sub(1));
            }
            match packet[0] {
                0xFF => match requests.next() {
                    Some(request) => socket.send(&request),
                    None => port_ready(),
                },
                0xFD => return got,
                // The second packet completes the tick.
                1 => {
                    got.samples += 1;
                    last = sent.recv().unwrap_or(last);
                    got.delays_us.push(1e6 * (now - last).as_secs_f64());
                }
                _ => {}
            }
            rest = next;
        }
        bytes = rest.to_vec();
    }
}

fn run(is_udp: bool, ticks: u64) {
    let server = Server::bind("127.0.0.1:0".parse().expect("an address")).expect("a port");
    let address = server.address();
    let mut slave = Description::new("bench", address);
    slave.measurements = (0..SIGNALS)
        .map(|number| Measurement {
            name: format!("signal_{number}"),
            description: String::new(),
            unit: "1".into(),
        })
        .collect();
    let image = Image::new(&slave, Fixed);
    let started = server.start(image, Pacing::Realtime, STEP_S, || true);
    let (feed, running) = started.expect("threads");
    let ((ready, is_ready), (send_time, sent)) = (channel(), channel());
    let master = thread::spawn(move || {
        let socket = Socket::new(is_udp, address.port());
        measure(socket, &|| ready.send(()).expect("a tick"), &sent)
    });
    is_ready.recv().expect("a master");
    let mut pacer = Pacer::new(STEP_S, &RealtimeOptions::default()).expect("1 kHz");
    let mut longest = Duration::ZERO;
    for tick in 1..=ticks {
        pacer.release(tick);
        let values: Vec<f64> = (0..SIGNALS)
            .map(|signal| (tick + signal as u64) as f64)
            .collect();
        let before = Instant::now();
        send_time.send(before).expect("a master");
        feed.tick(1e-3 * tick as f64, &values);
        longest = longest.max(before.elapsed());
    }
    pacer.end();
    drop(feed);
    let summary = running.finish().expect("a server");
    let mut got = master.join().expect("a master");
    got.delays_us.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| {
        let index = (share * (got.delays_us.len() - 1) as f64).round() as usize;
        span(1e3 * got.delays_us[index])
    };
    println!(
        "{}: {} of {ticks} samples of {SIGNALS} signals; {} ticks lost by the server, {} messages by the counters; \
         until the master has a sample: median {}, 99 % {}, longest {}; passing a tick on: longest {}",
        if is_udp { "UDP" } else { "TCP" },
        got.samples,
        summary.lost_ticks,
        got.lost_messages,
        at(0.5),
        at(0.99),
        at(1.0),
        span(longest.as_nanos() as f64),
    );
}

fn main() {
    let seconds = std::env::args().find_map(|argument| argument.parse::<u64>().ok());
    let ticks = 1000 * seconds.unwrap_or(10);
    run(false, ticks);
    run(true, ticks);
}
