//! The server on sockets of this machine: sessions, lost ticks, and a model in virtual time.

use std::io::{Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::sync::Arc;
use std::time::Duration;

use dashpot_core::xcp::ethernet::{header, split};
use dashpot_host_link::xcp::{Feed, Gate, Image, Pacing, Running, Server};

use crate::master::{LIST, Pages, description};

/// Far longer than any answer takes.
const PATIENCE: Duration = Duration::from_secs(60);

fn pages() -> Pages {
    Pages {
        values: [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        page: 0,
    }
}

/// A server on a free port, and its port.
fn start(pacing: Pacing) -> (Feed, Running, u16) {
    let server = Server::bind("127.0.0.1:0".parse().unwrap()).unwrap();
    let port = server.address().port();
    let image = Image::new(&description(8), pages());
    let (feed, running) = server.start(image, pacing, 1e-3, || false).unwrap();
    (feed, running, port)
}

/// A master on a stream.
struct Master {
    stream: TcpStream,
    received: Vec<u8>,
}

impl Master {
    fn new(port: u16) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        Self {
            stream,
            received: Vec::new(),
        }
    }

    fn send(&mut self, packet: &[u8]) {
        let message = [&header(packet.len() as u16, 0)[..], packet].concat();
        self.stream.write_all(&message).unwrap();
    }

    /// The next message: its counter and its packet.
    fn receive(&mut self) -> (u16, Vec<u8>) {
        loop {
            if let Some((packet, rest)) = split(&self.received) {
                let counter = u16::from_le_bytes([self.received[2], self.received[3]]);
                let (packet, rest) = (packet.to_vec(), rest.to_vec());
                self.received = rest;
                return (counter, packet);
            }
            let mut bytes = [0; 4096];
            let length = self.stream.read(&mut bytes).unwrap();
            assert!(length > 0, "the server has closed the connection");
            self.received.extend_from_slice(&bytes[..length]);
        }
    }

    /// Sends a packet and returns the positive response; samples before it are left out.
    fn ask(&mut self, packet: &[u8]) -> Vec<u8> {
        self.send(packet);
        loop {
            let (_, response) = self.receive();
            if response[0] == 0xFF {
                return response;
            }
            assert!(response[0] < 0xFC, "{packet:x?}: {response:x?}");
        }
    }

    fn connect_and_measure(&mut self) {
        self.ask(&[0xFF, 0]);
        for packet in LIST {
            self.ask(packet);
        }
    }
}

#[test]
fn lost_ticks_are_seen_by_the_master() {
    let (feed, running, port) = start(Pacing::Realtime);
    let mut master = Master::new(port);
    master.connect_and_measure();
    // Ten responses: to CONNECT and to the list.
    let (mut counter, mut sent, mut lost) = (9_u16, 0_u32, 0);
    // The master does not read, so at last the server is too slow. Its buffers hold several hundred thousand ticks.
    let values = [0.5; 8];
    for tick in 1..=400_000 {
        feed.tick(1e-3 * f64::from(tick), &values);
        sent += 1;
    }
    // Another tick, which comes after those that are waiting.
    let mut samples = 0_u32;
    let mut overloads = 0;
    let mut last_us = 0;
    let mut is_leaving = false;
    loop {
        let (number, packet) = master.receive();
        let before = std::mem::replace(&mut counter, number);
        lost += u32::from(number.wrapping_sub(before).wrapping_sub(1));
        match packet[..] {
            [0xFD, 0x06, 0, 0] => overloads += 1,
            [0, 0, ..] => {
                samples += 1;
                last_us = u32::from_le_bytes(packet[2..6].try_into().unwrap());
            }
            // The answer to DISCONNECT.
            [0xFF, ..] if is_leaving => break,
            _ => panic!("{packet:x?}"),
        }
        if is_leaving || (overloads == 0 && samples + 8192 < sent) {
            continue;
        }
        sent += 1;
        feed.tick(1e-3 * f64::from(sent), &values);
        if overloads > 0 && samples + lost >= 400_000 {
            is_leaving = true;
            master.send(&[0xFE]);
        }
    }
    assert!(overloads > 0 && lost > 0);
    assert!(last_us >= 1000 * 400_000);
    drop(feed);
    let summary = running.finish().unwrap();
    assert_eq!(summary.lost_ticks % 0x10000, u64::from(lost) % 0x10000);
}

#[test]
fn a_model_in_virtual_time_waits_for_the_measurement() {
    let gate = Arc::new(Gate::default());
    let (feed, running, port) = start(Pacing::Virtual(Arc::clone(&gate)));
    let model = std::thread::spawn(move || {
        for tick in 1..=1000 {
            gate.pass(|| false);
            feed.tick(1e-3 * f64::from(tick), &[f64::from(tick); 8]);
        }
    });
    let mut master = Master::new(port);
    master.connect_and_measure();
    let mut ticks = Vec::new();
    while ticks.len() < 1000 {
        // Stops and starts again, after which no tick is missing.
        if ticks.len() % 100 == 50 {
            master.send(&[0xDE, 0, 0, 0]);
            loop {
                let (_, packet) = master.receive();
                match packet[0] {
                    0 => ticks.push(f64::from_le_bytes(packet[6..14].try_into().unwrap())),
                    _ => break,
                }
            }
            let clock = master.ask(&[0xDC]);
            let clock_us = u32::from_le_bytes(clock[4..8].try_into().unwrap());
            // The model stands at the last sample.
            assert_eq!(f64::from(clock_us), 1000.0 * ticks.last().unwrap());
            if ticks.len() == 1000 {
                break;
            }
            master.ask(&[0xDE, 1, 0, 0]);
        }
        let (_, packet) = master.receive();
        ticks.push(f64::from_le_bytes(packet[6..14].try_into().unwrap()));
    }
    assert_eq!(ticks, (1..=1000).map(f64::from).collect::<Vec<_>>());
    model.join().unwrap();
    master.ask(&[0xFE]);
    assert_eq!(running.finish().unwrap().measured_ticks, 1000);
}

#[test]
fn a_silent_master_on_udp_is_replaced_unless_it_measures() {
    let (feed, running, port) = start(Pacing::Realtime);
    let master = || {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        socket.connect(("127.0.0.1", port)).unwrap();
        socket.set_read_timeout(Some(PATIENCE)).unwrap();
        socket
    };
    let ask = |socket: &UdpSocket, packet: &[u8]| {
        let message = [&header(packet.len() as u16, 0)[..], packet].concat();
        socket.send(&message).unwrap();
        let mut bytes = [0; 2000];
        let length = socket.recv(&mut bytes).unwrap();
        bytes[4..length].to_vec()
    };
    let (first, second) = (master(), master());
    assert_eq!(ask(&first, &[0xFF, 0])[0], 0xFF);
    // The first one says nothing more: the second one is served.
    assert_eq!(ask(&second, &[0xFF, 0])[0], 0xFF);
    for packet in LIST {
        assert_eq!(ask(&second, packet)[0], 0xFF, "{packet:x?}");
    }
    // The second one measures: the first one is ignored.
    first.send(&[2, 0, 0, 0, 0xFF, 0]).unwrap();
    assert_eq!(ask(&second, &[0xFD])[..2], [0xFF, 0x40]);
    assert_eq!(ask(&second, &[0xFE]), [0xFF]);
    drop(feed);
    assert_eq!(running.finish().unwrap().sessions, 2);
}
