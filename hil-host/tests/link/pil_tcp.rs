//! TCP link to a peer that delays small packets until the previous one is acknowledged (Nagle).
#![cfg(target_os = "linux")]

use std::io::Write;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::time::Duration;

use dashpot_host_link::{Link, Tcp};
use rustix::net::sockopt::{set_tcp_quickack, tcp_quickack};

#[test]
fn received_data_is_acknowledged_at_once() {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
    let (mut peer, _) = listener.accept().unwrap();
    let same = stream.try_clone().unwrap();
    let mut link = Tcp::over(stream, "peer".into()).unwrap();
    for _ in 0..3 {
        // The system leaves the socket in this state after answers have carried acknowledgements.
        set_tcp_quickack(&same, false).unwrap();
        peer.write_all(b"x").unwrap();
        let received = link.receive(&mut [0; 8], Duration::from_secs(300));
        assert_eq!(received.unwrap(), 1);
        assert!(tcp_quickack(&same).unwrap());
    }
}
