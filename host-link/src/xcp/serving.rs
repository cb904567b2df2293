//! The thread of the server: ticks and packets in their order, one session at a time.

use std::collections::{HashMap, VecDeque};
use std::net::{SocketAddr, TcpStream, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use dashpot_core::xcp::{Command, EV_DAQ_OVERLOAD, EV_SESSION_TERMINATED, EVENT_PACKET, Response};

use super::input::Input;
use super::outlet::{Gone, Master, Outlet};
use super::{Image, Pacing, Parameters, Slave, Summary};
use dashpot_core::xcp::ethernet::split;

/// Time between checks whether the server is still wanted.
const CHECK: Duration = Duration::from_millis(20);
/// Time that a silent master keeps the server alive after the last tick, and its session if it measures on UDP.
const LINGER: Duration = Duration::from_secs(10);
/// The only event channel.
const TICK: u16 = 0;

/// Ends of the server, and the step of its model.
pub(super) struct Run {
    /// Tells the threads of the sockets that the server has ended.
    pub is_over: Arc<AtomicBool>,
    /// True if the user wants to end.
    pub is_unwanted: fn() -> bool,
    pub step_s: f64,
}

/// Who sends a packet.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sender {
    Udp(SocketAddr),
    Tcp(u64),
}

/// State of the thread.
pub(super) struct Serving<P> {
    slave: Box<Slave>,
    image: Image<P>,
    pacing: Pacing,
    inputs: Receiver<Input>,
    /// Packets that arrived while a measurement came to its end.
    deferred: VecDeque<Input>,
    lost: Arc<AtomicU64>,
    lost_before: u64,
    /// Packets of samples of the last tick.
    packets: usize,
    udp: UdpSocket,
    streams: HashMap<u64, TcpStream>,
    session: Option<Outlet>,
    /// When the next tick of a model in virtual time may be sent over UDP.
    due: Option<Instant>,
    heard: Instant,
    is_ended: bool,
    run: Run,
    summary: Summary,
}

impl<P: Parameters> Serving<P> {
    pub fn new(
        image: Image<P>,
        pacing: Pacing,
        (inputs, lost): (Receiver<Input>, Arc<AtomicU64>),
        udp: UdpSocket,
        run: Run,
    ) -> Self {
        Self {
            slave: Box::default(),
            image,
            pacing,
            inputs,
            deferred: VecDeque::new(),
            lost,
            lost_before: 0,
            packets: 0,
            udp,
            streams: HashMap::new(),
            session: None,
            due: None,
            heard: Instant::now(),
            is_ended: false,
            run,
            summary: Summary::default(),
        }
    }

    pub fn run(mut self) -> Summary {
        loop {
            let input = match self.deferred.pop_front() {
                Some(input) => Ok(input),
                None => self.inputs.recv_timeout(CHECK),
            };
            match input {
                Ok(input) => self.handle(input),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let is_left = self.session.is_none() || self.heard.elapsed() > LINGER;
            if self.is_ended && (is_left || (self.run.is_unwanted)()) {
                break;
            }
        }
        let _told = self.send(&[EVENT_PACKET, EV_SESSION_TERMINATED]);
        self.run.is_over.store(true, Ordering::Relaxed);
        self.summary
    }

    fn handle(&mut self, input: Input) {
        match input {
            Input::Tick { time_s, values } => self.tick(time_s, &values),
            Input::Ended => {
                self.is_ended = true;
                self.heard = Instant::now();
            }
            Input::Datagram { from, bytes } => {
                let mut rest = &bytes[..];
                while let Some((packet, next)) = split(rest) {
                    self.receive(Sender::Udp(from), packet);
                    rest = next;
                }
            }
            Input::Packet { number, packet } => self.receive(Sender::Tcp(number), &packet),
            Input::Opened { number, stream } => {
                self.streams.insert(number, stream);
            }
            Input::Closed { number } => {
                self.streams.remove(&number);
                if self.master() == Some(Sender::Tcp(number)) {
                    self.end_session();
                }
            }
        }
    }

    /// The master of the session.
    fn master(&self) -> Option<Sender> {
        self.session.as_ref().map(|outlet| match &outlet.master {
            Master::Udp(address) => Sender::Udp(*address),
            Master::Tcp(number, _) => Sender::Tcp(*number),
        })
    }

    fn end_session(&mut self) {
        self.slave.disconnect();
        self.session = None;
        self.open_gate();
    }

    /// Executes a packet of the master. Others are ignored, unless they may take over.
    fn receive(&mut self, sender: Sender, packet: &[u8]) {
        let command = packet.first().and_then(|code| Command::from_code(*code));
        match self.master() {
            Some(master) if master == sender => self.heard = Instant::now(),
            Some(Sender::Udp(_)) if command == Some(Command::Connect) && self.is_free() => {
                self.end_session();
            }
            Some(_) => return,
            None => {}
        }
        if command.is_some_and(can_stop) {
            self.settle();
        }
        let response = self.slave.receive(packet, &mut self.image);
        let Some(response) = response else { return };
        if self.session.is_none() {
            self.begin_session(sender);
        }
        self.summary.commands += 1;
        if command.is_none() || is_refusal(&response) {
            self.summary.refused_commands += 1;
        }
        let sent = self.send(&response);
        if sent.is_err() || !self.slave.is_connected() {
            self.end_session();
        }
        self.open_gate();
    }

    /// True if another master may take over from one that cannot be seen to be gone.
    fn is_free(&self) -> bool {
        !self.slave.is_measuring() || self.heard.elapsed() > LINGER
    }

    fn begin_session(&mut self, sender: Sender) {
        let master = match sender {
            Sender::Udp(address) => Some(Master::Udp(address)),
            Sender::Tcp(number) => {
                let stream = self.streams.get(&number).map(TcpStream::try_clone);
                stream.and_then(|stream| Some(Master::Tcp(number, stream.ok()?)))
            }
        };
        self.session = master.map(Outlet::new);
        self.heard = Instant::now();
        self.summary.sessions += 1;
    }

    /// Sends a packet to the master.
    fn send(&mut self, packet: &[u8]) -> Result<(), Gone> {
        let outlet = self.session.as_mut().ok_or(Gone)?;
        outlet.send(packet, &self.udp, self.run.is_unwanted)?;
        outlet.flush(&self.udp, self.run.is_unwanted)
    }

    /// Measures a tick.
    fn tick(&mut self, time_s: f64, values: &[f64]) {
        self.image.update(time_s, values);
        let lost = self.lost.load(Ordering::Relaxed);
        let missing = lost - std::mem::replace(&mut self.lost_before, lost);
        if self.slave.is_measuring() && self.measure(missing).is_err() {
            self.end_session();
        }
        if let Pacing::Virtual(gate) = &self.pacing {
            gate.take();
        }
    }

    /// Samples the running lists, before which as many ticks are missing.
    fn measure(&mut self, missing: u64) -> Result<(), Gone> {
        let outlet = self.session.as_mut().ok_or(Gone)?;
        if missing > 0 {
            self.summary.lost_ticks += missing;
            // Before the first sample nobody knows how many packets a tick has.
            outlet.skip(missing * self.packets.max(1) as u64);
            let [low, high] = TICK.to_le_bytes();
            let event = [EVENT_PACKET, EV_DAQ_OVERLOAD, low, high];
            outlet.send(&event, &self.udp, self.run.is_unwanted)?;
        }
        let mut sent = Ok(());
        let packets = self.slave.sample(TICK, &self.image, |packet| {
            if sent.is_ok() {
                sent = outlet.send(packet, &self.udp, self.run.is_unwanted);
            }
        });
        sent?;
        outlet.flush(&self.udp, self.run.is_unwanted)?;
        if packets > 0 {
            self.packets = packets;
            self.summary.measured_ticks += 1;
        }
        if let (Pacing::Virtual(_), Master::Udp(_)) = (&self.pacing, &outlet.master) {
            self.wait_until_due();
        }
        Ok(())
    }

    /// Sleeps so that ticks follow each other no faster than in real time.
    fn wait_until_due(&mut self) {
        let now = Instant::now();
        let due = self.due.filter(|due| *due > now).unwrap_or(now);
        std::thread::sleep(due - now);
        self.due = Some(due + Duration::from_secs_f64(self.run.step_s));
    }

    /// Lets a model in virtual time step while a list is running.
    fn open_gate(&mut self) {
        if let Pacing::Virtual(gate) = &self.pacing {
            gate.set_open(self.slave.is_measuring());
        }
    }

    /// Before a measurement stops in virtual time: stops the model and measures the ticks that it has made, so that it
    /// stands where the last sample was.
    fn settle(&mut self) {
        let Pacing::Virtual(gate) = &self.pacing else {
            return;
        };
        let gate = Arc::clone(gate);
        if !self.slave.is_measuring() {
            return;
        }
        gate.set_open(false);
        while self.slave.is_measuring() && !gate.is_settled() && !self.is_ended {
            match self.inputs.recv_timeout(Duration::from_millis(1)) {
                Ok(input @ (Input::Tick { .. } | Input::Ended)) => self.handle(input),
                Ok(input) => self.deferred.push_back(input),
                Err(_) if (self.run.is_unwanted)() => return,
                Err(_) => {}
            }
        }
    }
}

/// True if a command can stop a measurement.
fn can_stop(command: Command) -> bool {
    matches!(
        command,
        Command::Connect
            | Command::Disconnect
            | Command::StartStopDaqList
            | Command::StartStopSynch
    )
}

/// True for an error packet, but for the answer to SYNCH.
fn is_refusal(response: &Response) -> bool {
    matches!(response[..], [0xFE, code] if code != 0)
}
