//! What the server's thread waits for.

use std::net::{SocketAddr, TcpStream};

/// Something that has happened.
pub(super) enum Input {
    /// The model has made a tick that ended at `time_s`.
    Tick { time_s: f64, values: Vec<f64> },
    /// The model makes no more ticks.
    Ended,
    /// A datagram.
    Datagram { from: SocketAddr, bytes: Vec<u8> },
    /// A connection.
    Opened { number: u64, stream: TcpStream },
    /// A packet of a connection.
    Packet { number: u64, packet: Vec<u8> },
    /// The other end of a connection is gone.
    Closed { number: u64 },
}
