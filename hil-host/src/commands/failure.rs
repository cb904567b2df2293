//! Failures of commands: exit codes, and messages that name command-line options.

use std::fmt;

use dashpot_core::BuildError;
use dashpot_rail::contact::PairError;
use dashpot_reference::ReferenceError;

use super::remedy::{option_of, with_remedy};
use dashpot_export::ExportError;
use dashpot_files::FileError;
use dashpot_files::actuator::ActuatorFileError;
use dashpot_files::case::CaseError;
use dashpot_files::damper::{ContentError, DamperError, FORM};
use dashpot_files::harmonic::{HarmonicError, MAX_AMPLITUDE_M, MAX_FREQUENCY_HZ};
use dashpot_files::profile::NamedProfileError;
use dashpot_files::sheet::SheetFileError;
use dashpot_files::study::StudyFileError;
use dashpot_files::track::TrackFileError;
use dashpot_files::vehicle::{FORM as VEHICLE_FORM, VehicleFileError};
use dashpot_host_link::{EmulatorError, LinkError, SessionError};
use dashpot_live::ActionError;
use dashpot_realtime::limits::TICKS_PER_ALLOWED_MISS;
use dashpot_realtime::options::RealtimeOption;
use dashpot_realtime::timing::span;
use dashpot_realtime::{RealtimeError, listed, stopped};
use dashpot_report::DrawError;
use dashpot_server::ServerError;
use dashpot_testbench::TestbenchError;
use dashpot_testbench::plate::PlateError;
use dashpot_vehicle_run::VehicleRunError;

/// A failure with a message that says what failed, where, and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    kind: Kind,
    message: String,
}

/// Kind of a failure, which determines the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A file is invalid, the system reports an error, or a result is not acceptable.
    Failed,
    /// The value of an option or a combination of options is not allowed.
    WrongUse,
    /// The reader closed the output: not an error, so no message is printed.
    OutputClosed,
}

/// Returns the options that help if a target does not answer in time; empty for other errors.
pub(super) fn remedy(error: &LinkError) -> &'static str {
    match error {
        LinkError::Silent { .. } => "; use a longer --timeout-ms or more --tries",
        LinkError::Emulator(EmulatorError::NotInstalled) => {
            "; on Debian and Ubuntu: apt-get install qemu-system-arm"
        }
        _ => "",
    }
}

/// Result of a command or of a part of it.
pub type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// Creates a failure with `message`.
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            kind: Kind::Failed,
            message: message.into(),
        }
    }

    /// Creates a wrong-use failure; `message` names the option and what is allowed.
    pub fn wrong_use(message: impl Into<String>) -> Self {
        Self {
            kind: Kind::WrongUse,
            message: message.into(),
        }
    }

    /// Returns the kind of the failure.
    pub fn kind(&self) -> Kind {
        self.kind
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// Converts errors whose text needs no change for the command line.
macro_rules! failures {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::new(error.to_string())
            }
        }
    )*};
}

failures!(
    ActionError,
    BuildError,
    DrawError,
    ReferenceError,
    toml::ser::Error
);

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        let kind = if error.is_broken_pipe() {
            Kind::OutputClosed
        } else {
            Kind::Failed
        };
        Self {
            kind,
            message: with_remedy(error.to_string(), dashpot_recording::remedy(&error)),
        }
    }
}

impl From<DamperError> for Failure {
    fn from(error: DamperError) -> Self {
        let message = match &error {
            DamperError::Override { assignment, reason } => {
                format!("--set {assignment}: {reason}; expected {FORM}")
            }
            DamperError::Content { name, source } | DamperError::Overridden { name, source } => {
                match source {
                    ContentError::Tables(reason) => format!("{name}: after --set: {reason}"),
                    other => format!("{name}: {other}"),
                }
            }
            other => other.to_string(),
        };
        match error {
            DamperError::Unknown(_)
            | DamperError::Override { .. }
            | DamperError::NoNumber { .. }
            | DamperError::Overridden { .. } => Self::wrong_use(message),
            _ => Self::new(message),
        }
    }
}

impl From<VehicleFileError> for Failure {
    fn from(error: VehicleFileError) -> Self {
        match &error {
            VehicleFileError::Override { assignment, reason } => Self::wrong_use(format!(
                "--set {assignment}: {reason}; expected {VEHICLE_FORM}"
            )),
            VehicleFileError::Overridden { name, message } => {
                Self::wrong_use(format!("{name}: after --set: {message}"))
            }
            VehicleFileError::Replacement {
                replacement,
                reason,
            } => Self::wrong_use(format!("--damper {replacement}: {reason}")),
            VehicleFileError::Unknown(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<TrackFileError> for Failure {
    fn from(error: TrackFileError) -> Self {
        match error {
            TrackFileError::File(error) => error.into(),
            TrackFileError::Unknown(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<CaseError> for Failure {
    fn from(error: CaseError) -> Self {
        match error {
            CaseError::File(error) => error.into(),
            CaseError::Vehicle(error) => error.into(),
            CaseError::Track(error) => error.into(),
            CaseError::Unknown(_) => Self::wrong_use(error.to_string()),
            CaseError::OutOfBounds {
                key,
                value,
                min,
                max,
            } => Self::wrong_use(format!(
                "{} {value}, allowed: {min} to {max}",
                option_of(key)
            )),
            CaseError::Override { assignment, reason } => {
                Self::wrong_use(format!("--set {assignment}: {reason}"))
            }
            CaseError::Contact(error) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<StudyFileError> for Failure {
    fn from(error: StudyFileError) -> Self {
        match error {
            StudyFileError::File(error) => error.into(),
            StudyFileError::Unknown(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<SheetFileError> for Failure {
    fn from(error: SheetFileError) -> Self {
        match error {
            SheetFileError::File(error) => error.into(),
            SheetFileError::Unknown(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<ActuatorFileError> for Failure {
    fn from(error: ActuatorFileError) -> Self {
        match error {
            ActuatorFileError::File(error) => error.into(),
            ActuatorFileError::Unknown(_) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<VehicleRunError> for Failure {
    fn from(error: VehicleRunError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<ServerError> for Failure {
    fn from(error: ServerError) -> Self {
        match error {
            ServerError::Token { .. } => Self::wrong_use(format!("--token: {error}")),
            ServerError::Listen { .. } => Self::new(format!("--listen: {error}")),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<TestbenchError> for Failure {
    fn from(error: TestbenchError) -> Self {
        match error {
            TestbenchError::Recording(error) => error.into(),
            TestbenchError::Motion(HarmonicError::Amplitude(amplitude_m)) => {
                Self::wrong_use(format!(
                    "--amplitude-m: {amplitude_m}, allowed: above 0 and at most {MAX_AMPLITUDE_M} m"
                ))
            }
            TestbenchError::Motion(HarmonicError::Frequency(frequency_hz)) => {
                Self::wrong_use(format!(
                    "--frequency-hz: {frequency_hz}, allowed: above 0 and at most {MAX_FREQUENCY_HZ} Hz"
                ))
            }
            TestbenchError::SweepRate { .. } | TestbenchError::SweepSteps { .. } => {
                Self::wrong_use(format!("--octaves-per-minute: {error}"))
            }
            TestbenchError::Step { .. }
            | TestbenchError::StepsPerCycle { .. }
            | TestbenchError::Velocity { .. }
            | TestbenchError::Displacement { .. } => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<PlateError> for Failure {
    fn from(error: PlateError) -> Self {
        match error {
            PlateError::Stack(error) => error.into(),
            PlateError::Area {
                key,
                given,
                allowed,
            } => Self::wrong_use(format!("{}: {given}, allowed: {allowed}", option_of(key))),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<RealtimeError> for Failure {
    fn from(error: RealtimeError) -> Self {
        match error {
            RealtimeError::Step { .. } => Self::wrong_use(error.to_string()),
            RealtimeError::Core { core, allowed } => Self::wrong_use(format!(
                "--core {core}: this process may not use this core; allowed: {}",
                listed(&allowed)
            )),
            RealtimeError::Refused { option, reason } => Self::new(match option {
                RealtimeOption::FifoPriority(priority) => format!("--fifo {priority}: {reason}"),
                RealtimeOption::LockMemory => format!("--lock-memory: {reason}"),
                RealtimeOption::NoDeepSleep => format!("--no-deep-sleep: {reason}"),
                RealtimeOption::Core(core) => format!("--core {core}: {reason}"),
            }),
            RealtimeError::Stopped(stop) => Self::new(format!(
                "{}, allowed by --stop-above-ns: {}",
                stopped(&stop),
                span(stop.limit_ns as f64)
            )),
            RealtimeError::TooManyMissed { missed, ticks } => Self::new(format!(
                "{missed} of {ticks} deadlines missed; allowed with --realtime: one in {TICKS_PER_ALLOWED_MISS}"
            )),
            RealtimeError::MissedDeadlines { missed, ticks } => Self::new(format!(
                "{missed} of {ticks} deadlines missed; allowed with --fail-on-miss: none"
            )),
            _ => Self::new(error.to_string()),
        }
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Self::wrong_use(match &error {
            ExportError::Scalar { scalar } => format!(
                "--scalar {scalar}: the C library uses single precision; allowed with --lang c: f32, or f64 with \
                 --standalone"
            ),
            ExportError::Include { .. } => format!("--output: {error}"),
            ExportError::Name { name, reason } => format!("--name {name}: {reason}"),
            _ => return Self::new(error.to_string()),
        })
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        match error {
            LinkError::CannotReset => Self::new(format!("{error}; use `--link qemu`")),
            LinkError::ResetFaults => Self::wrong_use(format!("{error}; use `--link qemu`")),
            LinkError::Emulator(EmulatorError::NoImage(_)) => Self::new(format!(
                "{error}; build it with `cargo xtask firmware`, or name one with --link qemu:IMAGE"
            )),
            _ => Self::new(format!("{error}{}", remedy(&error))),
        }
    }
}

impl From<SessionError> for Failure {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Link(error) => error.into(),
            SessionError::DamperCount { .. } => Self::wrong_use(format!("--damper: {error}")),
            SessionError::After { ref source, .. } => {
                Self::new(format!("{error}{}", remedy(source)))
            }
            other => Self::new(other.to_string()),
        }
    }
}

impl From<NamedProfileError> for Failure {
    fn from(error: NamedProfileError) -> Self {
        match error {
            NamedProfileError::File(error) => error.into(),
            NamedProfileError::Smoothing(smoothing_m) => Self::wrong_use(format!(
                "--smoothing-m: {smoothing_m}, allowed: 0 to 0.05 m"
            )),
            _ => Self::wrong_use(error.to_string()),
        }
    }
}

impl From<PairError> for Failure {
    fn from(error: PairError) -> Self {
        match error {
            PairError::Installation(error) => Self::wrong_use(error.to_string()),
            _ => Self::new(error.to_string()),
        }
    }
}
