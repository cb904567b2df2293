//! Sockets of the server: each has a thread that passes what arrives to the server's thread.

use std::io::{self, ErrorKind, Read};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use dashpot_core::xcp::ethernet::{HEADER_BYTES, split};

use super::input::Input;

/// Time between checks whether the server has ended.
const CHECK: Duration = Duration::from_millis(20);
/// Largest number of connections at the same time, of which one has the session.
const MAX_CONNECTIONS: u64 = 8;
/// Largest packet of a master; longer ones are none of this protocol.
const MAX_PACKET_BYTES: u16 = 0x1000;

/// UDP and TCP on one address.
pub(super) struct Sockets {
    pub address: SocketAddr,
    pub udp: UdpSocket,
    tcp: TcpListener,
}

impl Sockets {
    /// Binds both to the address. Port 0 is a free port, the same for both.
    pub fn bind(address: SocketAddr) -> io::Result<Self> {
        let tcp = TcpListener::bind(address)?;
        let address = tcp.local_addr()?;
        let udp = UdpSocket::bind(address)?;
        udp.set_read_timeout(Some(CHECK))?;
        tcp.set_nonblocking(true)?;
        Ok(Self { address, udp, tcp })
    }

    /// Starts the threads, which end soon after `is_over` is set.
    pub fn listen(
        self,
        inputs: SyncSender<Input>,
        is_over: Arc<AtomicBool>,
    ) -> io::Result<(UdpSocket, [JoinHandle<()>; 2])> {
        let udp = self.udp.try_clone()?;
        let (to_udp, udp_over) = (inputs.clone(), Arc::clone(&is_over));
        let datagrams = thread::Builder::new()
            .name("xcp udp".into())
            .spawn(move || receive_datagrams(&self.udp, &to_udp, &udp_over))?;
        let connections = thread::Builder::new()
            .name("xcp tcp".into())
            .spawn(move || accept(&self.tcp, &inputs, &is_over))?;
        Ok((udp, [datagrams, connections]))
    }
}

/// True if a socket had nothing to read in time.
fn is_idle(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
    )
}

fn receive_datagrams(socket: &UdpSocket, inputs: &SyncSender<Input>, is_over: &AtomicBool) {
    let mut bytes = vec![0; usize::from(u16::MAX)];
    while !is_over.load(Ordering::Relaxed) {
        // Errors are those of datagrams sent before, whose receiver is gone.
        let Ok((length, from)) = socket.recv_from(&mut bytes) else {
            continue;
        };
        let bytes = bytes[..length].to_vec();
        if inputs.send(Input::Datagram { from, bytes }).is_err() {
            return;
        }
    }
}

fn accept(listener: &TcpListener, inputs: &SyncSender<Input>, is_over: &Arc<AtomicBool>) {
    let open = Arc::new(AtomicU64::new(0));
    let mut readers: Vec<JoinHandle<()>> = Vec::new();
    let mut number = 0;
    while !is_over.load(Ordering::Relaxed) {
        let Ok((stream, _)) = listener.accept() else {
            thread::sleep(CHECK);
            continue;
        };
        readers.retain(|reader| !reader.is_finished());
        if open.load(Ordering::Relaxed) >= MAX_CONNECTIONS {
            continue;
        }
        number += 1;
        if let Ok(reader) = start_reader(number, stream, inputs, is_over, &open) {
            readers.push(reader);
        }
    }
    for reader in readers {
        let _joined = reader.join();
    }
}

fn start_reader(
    number: u64,
    stream: TcpStream,
    inputs: &SyncSender<Input>,
    is_over: &Arc<AtomicBool>,
    open: &Arc<AtomicU64>,
) -> io::Result<JoinHandle<()>> {
    stream.set_nonblocking(false)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(CHECK))?;
    stream.set_write_timeout(Some(CHECK))?;
    let reading = stream.try_clone()?;
    let (inputs, is_over, open) = (inputs.clone(), Arc::clone(is_over), Arc::clone(open));
    open.fetch_add(1, Ordering::Relaxed);
    thread::Builder::new()
        .name("xcp connection".into())
        .spawn(move || {
            if inputs.send(Input::Opened { number, stream }).is_ok() {
                read_packets(number, reading, &inputs, &is_over);
                let _is_sent = inputs.send(Input::Closed { number });
            }
            open.fetch_sub(1, Ordering::Relaxed);
        })
}

/// Reads until the other end is gone, sends something else than this protocol, or the server has ended.
fn read_packets(
    number: u64,
    mut stream: TcpStream,
    inputs: &SyncSender<Input>,
    is_over: &AtomicBool,
) {
    let mut pending: Vec<u8> = Vec::new();
    let mut bytes = [0; 4096];
    while !is_over.load(Ordering::Relaxed) {
        match stream.read(&mut bytes) {
            Ok(0) => return,
            Ok(length) => pending.extend_from_slice(&bytes[..length]),
            Err(error) if is_idle(&error) => continue,
            Err(_) => return,
        }
        while let Some((packet, rest)) = split(&pending) {
            let (packet, rest) = (packet.to_vec(), rest.to_vec());
            if inputs.send(Input::Packet { number, packet }).is_err() {
                return;
            }
            pending = rest;
        }
        let is_other = pending
            .first_chunk::<HEADER_BYTES>()
            .is_some_and(|header| u16::from_le_bytes([header[0], header[1]]) > MAX_PACKET_BYTES);
        if is_other {
            return;
        }
    }
}
