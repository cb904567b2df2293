//! Sends packets to the master.

use std::io::{ErrorKind, Write};
use std::net::{SocketAddr, TcpStream, UdpSocket};

use dashpot_core::xcp::ethernet::{HEADER_BYTES, header};

use super::MAX_DTO;

/// Largest datagram: one of the largest packets.
const MAX_DATAGRAM_BYTES: usize = HEADER_BYTES + MAX_DTO;

/// The master of a session.
#[derive(Debug)]
pub(super) enum Master {
    Udp(SocketAddr),
    Tcp(u64, TcpStream),
}

/// The master is gone, or the server is unwanted.
pub(super) struct Gone;

/// Messages to a master, collected until [`Self::flush`].
pub(super) struct Outlet {
    pub master: Master,
    counter: u16,
    messages: Vec<u8>,
}

impl Outlet {
    pub fn new(master: Master) -> Self {
        Self {
            master,
            counter: 0,
            messages: Vec::new(),
        }
    }

    /// Adds a packet. Several packets share a datagram if they fit.
    pub fn send(
        &mut self,
        packet: &[u8],
        udp: &UdpSocket,
        is_unwanted: fn() -> bool,
    ) -> Result<(), Gone> {
        let is_udp = matches!(self.master, Master::Udp(_));
        let bytes = self.messages.len() + HEADER_BYTES + packet.len();
        if is_udp && bytes > MAX_DATAGRAM_BYTES {
            self.flush(udp, is_unwanted)?;
        }
        let header = header(packet.len() as u16, self.counter);
        self.counter = self.counter.wrapping_add(1);
        self.messages.extend_from_slice(&header);
        self.messages.extend_from_slice(packet);
        Ok(())
    }

    /// Leaves out numbers of messages, so that the master sees that samples are missing.
    pub fn skip(&mut self, messages: u64) {
        self.counter = self.counter.wrapping_add(messages as u16);
    }

    /// Sends what was collected. A connection whose other end does not read is waited for.
    pub fn flush(&mut self, udp: &UdpSocket, is_unwanted: fn() -> bool) -> Result<(), Gone> {
        if self.messages.is_empty() {
            return Ok(());
        }
        let sent = match &mut self.master {
            Master::Udp(address) => udp.send_to(&self.messages, *address).map(drop),
            Master::Tcp(_, stream) => return write(stream, &mut self.messages, is_unwanted),
        };
        self.messages.clear();
        sent.map_err(|_| Gone)
    }
}

fn write(
    stream: &mut TcpStream,
    messages: &mut Vec<u8>,
    is_unwanted: fn() -> bool,
) -> Result<(), Gone> {
    let mut sent = 0;
    while sent < messages.len() {
        match stream.write(&messages[sent..]) {
            Ok(0) => return Err(Gone),
            Ok(bytes) => sent += bytes,
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
                    if !is_unwanted() => {}
                _ => return Err(Gone),
            },
        }
    }
    messages.clear();
    Ok(())
}
