//! A rig in another process or on another machine, behind UDP.

use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::time::{Duration, Instant};

use dashpot_core::hybrid::Measured;
use dashpot_core::hybrid::wire::{FRAME_BYTES, Frame, InboxCounts};
use dashpot_hybrid::rig::RigClient;

use crate::commands::failure::{Failure, Outcome};

/// How long the rig may take for its first answer, and how long a run that is not paced waits for that of a tick. On a
/// busy machine it takes seconds.
const ANSWER: Duration = Duration::from_secs(5);
/// Shortest timeout that all systems take.
const SHORTEST: Duration = Duration::from_micros(100);
/// Time after which the first command is sent again.
const RETRY: Duration = Duration::from_millis(2);
/// Time after which another first command is sent, because the answer to the one before may be lost.
const RENEWAL: Duration = Duration::from_secs(1);
/// Commands that end a session, because each can be lost.
const STOPS: u32 = 5;

/// A rig behind UDP.
pub(super) struct RemoteRig {
    name: String,
    socket: UdpSocket,
    client: RigClient,
    /// The vehicle waits for answers if it does not run in real time.
    is_realtime: bool,
    /// Readings that the first call of `receive` returns.
    first: Option<Measured>,
    /// True if the last answer did not come.
    is_silent: bool,
    is_stopped: bool,
    tick: Duration,
}

impl Drop for RemoteRig {
    fn drop(&mut self) {
        self.stop(0.0);
    }
}

impl RemoteRig {
    /// Opens a session with the rig at `address` (HOST:PORT); returns it and the first readings.
    ///
    /// # Errors
    /// The address is invalid, or the rig does not answer.
    pub(super) fn open(address: &str, step_s: f64, is_realtime: bool) -> Outcome<(Self, Measured)> {
        let failed = |error: std::io::Error| Failure::new(format!("udp:{address}: {error}"));
        let mut addresses = address.to_socket_addrs().map_err(|error| {
            Failure::wrong_use(format!("udp:{address}: {error}; allowed: udp:HOST:PORT"))
        })?;
        let remote = addresses.next();
        let remote = remote.ok_or_else(|| Failure::new(format!("udp:{address}: no address")))?;
        let local: SocketAddr = match remote {
            SocketAddr::V4(_) => (Ipv4Addr::UNSPECIFIED, 0).into(),
            SocketAddr::V6(_) => (Ipv6Addr::UNSPECIFIED, 0).into(),
        };
        let socket = UdpSocket::bind(local).map_err(failed)?;
        // Datagrams of other senders do not even arrive.
        socket.connect(remote).map_err(failed)?;
        let mut rig = Self {
            name: format!("udp:{address}"),
            socket,
            client: RigClient::new(fastrand::u32(1..), step_s),
            is_realtime,
            first: None,
            is_silent: false,
            is_stopped: false,
            tick: Duration::from_secs_f64(step_s),
        };
        rig.socket.set_read_timeout(Some(RETRY)).map_err(failed)?;
        let started = Instant::now();
        let mut renewed = started;
        let mut frame = rig.client.command(0.0, 0.0);
        loop {
            // A rig in step moves by a tick for each command, but not for a repeated one: its motion must not depend on
            // the time until the answer.
            if renewed.elapsed() > RENEWAL {
                renewed = Instant::now();
                frame = rig.client.command(0.0, 0.0);
            }
            rig.send_frame(&frame);
            if let Ok((Some(first), _)) = rig.take_one() {
                rig.socket.set_nonblocking(is_realtime).map_err(failed)?;
                rig.first = Some(first);
                return Ok((rig, first));
            }
            std::thread::sleep(SHORTEST);
            if started.elapsed() > ANSWER {
                return Err(Failure::new(format!(
                    "{}: no answer within {} s; is the rig running, and free of another session? `dashpot hybrid rig` \
                     starts a virtual one",
                    rig.name,
                    ANSWER.as_secs()
                )));
            }
        }
    }

    /// Sends the command (m) of a tick.
    pub(super) fn send(&mut self, time_s: f64, command_m: f32) {
        let frame = self.client.command(time_s, command_m);
        self.send_frame(&frame);
    }

    fn send_frame(&mut self, frame: &Frame) {
        // A datagram that cannot be sent is lost, like any other.
        let _ = self.socket.send(&frame.to_bytes());
    }

    /// Returns the newest readings since the last call. In real time it takes what has arrived; otherwise it waits for
    /// the answer to the last command, and after an answer that did not come for a tick at a time.
    pub(super) fn receive(&mut self) -> Option<Measured> {
        let mut newest = self.first.take();
        if self.is_realtime {
            while let Ok((readings, _)) = self.take_one() {
                newest = readings.or(newest);
            }
            return newest;
        }
        if newest.is_some() {
            return newest;
        }
        let wait = if self.is_silent { self.tick } else { ANSWER };
        let started = Instant::now();
        let mut is_last = false;
        while !is_last && started.elapsed() < wait {
            let left = wait.saturating_sub(started.elapsed()).max(SHORTEST);
            // Without its timeout the socket would wait for ever.
            if self.socket.set_read_timeout(Some(left)).is_err() {
                break;
            }
            // An error means that nothing came, or that nobody is there.
            let Ok((readings, answers)) = self.take_one() else {
                break;
            };
            newest = readings.or(newest);
            is_last = answers == Some(self.client.sequence());
        }
        self.is_silent = newest.is_none();
        newest
    }

    /// Takes one datagram; returns its readings and the command that it answers, if it is a new answer.
    fn take_one(&mut self) -> std::io::Result<(Option<Measured>, Option<u32>)> {
        // One byte more than a datagram has shows that one is too long.
        let mut bytes = [0; FRAME_BYTES + 1];
        let count = self.socket.recv(&mut bytes)?;
        let taken = self.client.take(&bytes[..count]);
        Ok(taken.unzip())
    }

    /// True if the rig holds its displacement and follows no command.
    pub(super) fn is_held(&self) -> bool {
        self.client.is_held()
    }

    /// Ends the session.
    pub(super) fn stop(&mut self, time_s: f64) {
        if std::mem::replace(&mut self.is_stopped, true) {
            return;
        }
        for _ in 0..STOPS {
            let frame = self.client.stop(time_s);
            self.send_frame(&frame);
        }
    }

    /// Seconds of the rig for each second of the vehicle.
    pub(super) fn clock_ratio(&self) -> Option<f64> {
        self.client.clock_ratio()
    }

    /// Answers with the actuator at a limit.
    pub(super) fn saturated(&self) -> u64 {
        self.client.saturated()
    }

    /// Counts of the answers.
    pub(super) fn counts(&self) -> InboxCounts {
        self.client.counts()
    }
}
