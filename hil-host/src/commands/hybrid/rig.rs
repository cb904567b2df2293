//! `dashpot hybrid rig`: a virtual rig in a process of its own, behind UDP.

use std::io::{self, ErrorKind, Write};
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use dashpot_core::hybrid::wire::FRAME_BYTES;
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::damper;
use dashpot_hybrid::rig::{KeeperSettings, RigServer, VirtualRig};
use dashpot_realtime::pacing::Pacer;
use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::paced::Paced;
use crate::commands::vehicle::Datagrams;
use crate::commands::{Format, RealtimeArguments, interruption, print_report};

/// Run a virtual rig in real time: an actuator moves a damper, and datagrams (UDP) bring commands and take away
/// readings.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot hybrid rig --actuator servo --damper in-service
  dashpot hybrid rig --actuator slow.toml --damper worn.toml --listen 127.0.0.1:9200 --duration-s 60

and in another terminal
  dashpot vehicle --case straight-180 --outside \"front lateral damper 1=udp:127.0.0.1:9100\" --actuator servo --realtime

docs/rig-protocol.md describes the datagrams. The first vehicle that starts a session has the rig until the
session is over and the actuator at rest. If commands do not arrive, the actuator goes on at the last rate for --extrapolate-ticks,
then comes to rest in 0.2 s and holds until the next session. Ctrl-C ends the rig and prints its report.")]
pub(super) struct RigArguments {
    /// Actuator: built-in name (servo, second-order, slow, benchmark) or TOML file.
    #[arg(long, value_name = "ACTUATOR")]
    actuator: String,
    /// Damper on the rig: preset or TOML file.
    #[arg(long, value_name = "DAMPER")]
    damper: String,
    /// Override a value of the damper: table.key=value. May be repeated.
    #[arg(long = "set", value_name = "TABLE.KEY=VALUE")]
    overrides: Vec<String>,
    /// Address to listen on. Only this machine can reach the default; 0.0.0.0:9100 is for all.
    #[arg(long, default_value = "127.0.0.1:9100", value_name = "ADDRESS:PORT")]
    listen: SocketAddr,
    /// Step of the rig, us.
    #[arg(long, default_value_t = 1000, value_name = "US", value_parser = clap::value_parser!(u32).range(100..=1000))]
    step_us: u32,
    /// Ticks in a row without a command in which the actuator goes on at the last rate.
    #[arg(long, default_value_t = 10, value_name = "TICKS", value_parser = clap::value_parser!(u32).range(0..=1000))]
    extrapolate_ticks: u32,
    /// Make a tick for each new command instead of real time: the time of the rig passes as commands arrive.
    #[arg(long, conflicts_with_all = ["fifo", "lock_memory", "core", "no_deep_sleep"])]
    in_step: bool,
    /// End after this time [default: run until interrupted].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u64).range(1..))]
    duration_s: Option<u64>,
    /// Seed of the noise.
    #[arg(long, default_value_t = 1, value_name = "SEED")]
    seed: u64,
    #[command(flatten)]
    realtime: RealtimeArguments,
    /// Output format of the report.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Report {
    actuator: String,
    damper: String,
    ticks: u64,
    sessions: u32,
    /// Commands of the last session; foreign datagrams of all.
    commands: Datagrams,
    longest_gap_ticks: u32,
    is_held: bool,
    saturated_ticks: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    realtime: Option<Paced>,
}

/// Time in which an actuator without commands comes to rest, s.
const RAMP_S: f64 = 0.2;

/// Time without a command after which a rig in step takes its vehicle for gone.
const GONE: Duration = Duration::from_secs(1);

/// How often a rig that waits for datagrams looks whether it shall end.
const LOOK: Duration = Duration::from_millis(50);

/// Largest number of datagrams that are read in a tick, so that a flood cannot hold it up.
const MAX_DATAGRAMS: u32 = 64;

/// A rig and its socket.
struct Served {
    server: RigServer,
    socket: UdpSocket,
    /// Where answers go.
    peer: Option<SocketAddr>,
}

/// Runs the command.
///
/// # Errors
/// An argument or a file is invalid, the address cannot be used, or the system refuses a real-time option.
pub(super) fn run(arguments: &RigArguments) -> Outcome<()> {
    let step_s = 1e-6 * f64::from(arguments.step_us);
    let actuator = ActuatorParameters::load(&arguments.actuator)?;
    let damper = damper::load(&arguments.damper, &arguments.overrides)?;
    let rig = VirtualRig::new(&actuator, &damper, step_s, arguments.seed).map_err(|error| {
        let (actuator, damper) = (&arguments.actuator, &arguments.damper);
        Failure::new(format!("{actuator} with {damper}: {error}"))
    })?;
    let limits = actuator.limits;
    let settings = KeeperSettings {
        extrapolated_ticks: arguments.extrapolate_ticks,
        ramp_s: RAMP_S,
        velocity_m_per_s: limits.velocity_m_per_s,
        stroke_m: limits.stroke_m,
    };
    let listen = arguments.listen;
    let failed = |error: io::Error| Failure::new(format!("--listen {listen}: {error}"));
    let socket = UdpSocket::bind(listen).map_err(failed)?;
    let address = socket.local_addr().map_err(failed)?;
    let mut served = Served {
        server: RigServer::new(rig, settings, step_s),
        socket,
        peer: None,
    };
    let note = format!(
        "{} with {}: listening on {address}; Ctrl-C ends\n",
        actuator.name, arguments.damper
    );
    let _ = io::stderr().lock().write_all(note.as_bytes());
    let _ends_gently = interruption::end_gently();
    let pacing = match arguments.in_step {
        true => {
            served.socket.set_read_timeout(Some(LOOK)).map_err(failed)?;
            let end = arguments.duration_s.map(Duration::from_secs);
            served.follow_commands(end);
            None
        }
        false => {
            served.socket.set_nonblocking(true).map_err(failed)?;
            let mut pacer = Pacer::new(step_s, &arguments.realtime.options())?;
            let ticks = arguments
                .duration_s
                .map(|seconds| (seconds as f64 / step_s) as u64);
            let mut tick = 0;
            while !interruption::is_wanted() && ticks.is_none_or(|ticks| tick < ticks) {
                let timing = pacer.wait(tick);
                served.drain();
                served.tick();
                pacer.finish(timing);
                tick += 1;
            }
            Some(pacer.into_report())
        }
    };
    let server = &mut served.server;
    let report = Report {
        actuator: actuator.name.clone(),
        damper: arguments.damper.clone(),
        ticks: server.ticks(),
        sessions: server.sessions(),
        commands: server.counts().into(),
        longest_gap_ticks: server.longest_gap(),
        is_held: server.is_held(),
        saturated_ticks: server.rig().saturated_ticks(),
        realtime: pacing.as_ref().map(Paced::from),
    };
    print_report(arguments.format, &report, print)
}

impl Served {
    /// Takes the datagrams that have arrived.
    fn drain(&mut self) {
        for _ in 0..MAX_DATAGRAMS {
            if self.receive().is_err() {
                return;
            }
        }
    }

    /// Takes one datagram; returns whether it is a new command.
    fn receive(&mut self) -> io::Result<bool> {
        // One byte more than a datagram has shows that one is too long.
        let mut bytes = [0; FRAME_BYTES + 1];
        let (count, sender) = self.socket.recv_from(&mut bytes)?;
        let is_command = self.server.take(&bytes[..count]);
        if is_command {
            self.peer = Some(sender);
        }
        Ok(is_command)
    }

    /// Makes a tick and answers.
    fn tick(&mut self) {
        if let (Some(answer), Some(peer)) = (self.server.tick(), self.peer) {
            // An answer that cannot be sent is lost, like any other.
            let _ = self.socket.send_to(&answer.to_bytes(), peer);
        }
    }

    /// Makes a tick for each new command.
    fn follow_commands(&mut self, end: Option<Duration>) {
        let started = Instant::now();
        let mut last_command = started;
        while !interruption::is_wanted() && end.is_none_or(|end| started.elapsed() < end) {
            match self.receive() {
                Ok(true) => {
                    last_command = Instant::now();
                    self.tick();
                }
                // An answer to a vehicle that has gone: the next one may come.
                Err(error) if !is_silence(&error) => std::thread::yield_now(),
                Ok(false) | Err(_) => {}
            }
            // The next vehicle may already knock, so that there is no silence.
            if last_command.elapsed() > GONE {
                self.server.release();
            }
        }
    }
}

fn is_silence(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{} with {}: {} ticks, {} sessions; {}",
        report.actuator,
        report.damper,
        report.ticks,
        report.sessions,
        match (report.sessions, report.is_held) {
            (0, _) => "nobody has come",
            (_, true) => "the rig holds",
            (_, false) => "the rig follows commands",
        }
    )?;
    writeln!(
        out,
        "commands  {}; at most {} ticks in a row without one",
        report.commands.text(),
        report.longest_gap_ticks
    )?;
    writeln!(
        out,
        "actuator  {} ticks at a limit of valve, velocity or force",
        report.saturated_ticks
    )?;
    match &report.realtime {
        Some(paced) => paced.write(out, "work of a tick"),
        None => Ok(()),
    }
}
