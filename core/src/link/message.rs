//! Requests of a host and responses of a device, encoded with postcard.
//!
//! The fields of requests and responses are part of the protocol; a new field needs a new [version](super::PROTOCOL).

use serde::{Deserialize, Serialize};

use super::lists::{PerDamper, Reals, Samples};
use super::refusal::Refusal;
use super::safe_output::LossOfLink;
use crate::health::HealthReading;

/// Header of a request, repeated in its response.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Session number, chosen by the host in its hello.
    pub session: u16,
    /// Sequence number: increases by one with each request of a session and wraps. A repeated request keeps its number.
    pub sequence: u32,
}

/// Request of a host. Displacements (m) are positive in extension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Request<'a> {
    /// Opens the session of the header. Changes no state.
    Hello {
        /// [`PROTOCOL`](super::PROTOCOL) of the host.
        protocol: u16,
    },
    /// Checks an image and replaces a damper with it; the state keeps its force.
    Load {
        /// Index of the damper.
        damper: u8,
        /// Whole image from [`Damper::to_image`](crate::Damper).
        image: &'a [u8],
    },
    /// Changes one parameter of one damper immediately.
    Set {
        /// Index of the damper.
        damper: u8,
        /// The parameter.
        parameter: Parameter,
        /// New value, in the unit of the parameter's name.
        value: f32,
    },
    /// Configures the response to a loss of the link.
    LossOfLink(LossOfLink),
    /// Puts every damper at rest at these displacements and sets the tick to 0.
    Reset {
        /// Displacement of each damper (m).
        displacements_m: Reals,
    },
    /// Steps every damper once.
    Step {
        /// Tick of these displacements: the last tick plus one.
        tick: u32,
        /// Displacement of each damper (m).
        displacements_m: Reals,
    },
    /// Starts the free-running tick with every damper at rest at these displacements. Also recovers from a loss of the
    /// link.
    Run {
        /// Displacement of each damper (m).
        displacements_m: Reals,
    },
    /// Sets the displacements of the following free-running ticks.
    Displace {
        /// Displacement of each damper (m).
        displacements_m: Reals,
    },
    /// Stops the free-running tick.
    Stop,
    /// Requests the states of all dampers.
    Save,
    /// Restores the states of all dampers, or of none.
    Restore {
        /// Tick of the states.
        tick: u32,
        /// [`DamperState::to_bytes`](crate::DamperState) of each damper, in order.
        states: &'a [u8],
    },
    /// Takes the oldest telemetry samples of one damper that were not yet taken.
    Telemetry {
        /// Index of the damper.
        damper: u8,
    },
    /// Requests the counters.
    Counters,
    /// Requests the present outputs.
    Outputs,
    /// Requests status bits and rejected inputs.
    Status,
    /// Clears status bits and rejected inputs of every damper. The response contains the cleared values.
    ClearStatus,
    /// Checks a health model and starts an estimate for one damper with it.
    LoadHealth {
        /// Index of the damper.
        damper: u8,
        /// Whole image from [`HealthModel::to_image`](crate::health::HealthModel::to_image).
        image: &'a [u8],
    },
    /// Feeds the health estimate with samples of a real damper, one for each step.
    Measure {
        /// Index of the damper.
        damper: u8,
        /// Displacement (m) and force (N) of each sample in single precision, little-endian; at most
        /// [`MAX_MEASURED`](super::MAX_MEASURED) samples.
        samples: &'a [u8],
    },
    /// Requests the health of a damper.
    Health {
        /// Index of the damper.
        damper: u8,
    },
    /// Clears status bits and rejected samples of a health estimate. The response contains the cleared values.
    ClearHealth {
        /// Index of the damper.
        damper: u8,
    },
}

/// Parameters of a damper file. Only the clearance can change without a rebuild.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Parameter {
    /// `mount.clearance_m`: 2a, the total play.
    ClearanceM,
    /// `mount.stiffness_n_per_m`.
    StiffnessNPerM,
    /// `reduced.damping_n_s_per_m`.
    DampingNSPerM,
    /// `reduced.saturation_velocity_m_per_s`.
    SaturationVelocityMPerS,
    /// `limits.force_n`.
    ForceLimitN,
}

/// Response of a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Response<'a> {
    /// Answers hello.
    #[serde(borrow)]
    Welcome(Welcome<'a>),
    /// The request was carried out.
    Done,
    /// Answers step, run and displace.
    Forces(Forces),
    /// Answers save.
    Saved {
        /// Last tick.
        tick: u32,
        /// [`DamperState::to_bytes`](crate::DamperState) of each damper, in order.
        states: &'a [u8],
    },
    /// Answers telemetry.
    Telemetry {
        /// Number of samples of the damper that were overwritten before they were taken.
        overwritten: u32,
        /// Samples, oldest first.
        samples: Samples,
    },
    /// Answers counters.
    Counters(Counters),
    /// Answers outputs.
    Outputs {
        /// Last values of the outputs (N), positive when they resist extension.
        outputs_n: Reals,
    },
    /// Answers status and clear status.
    Status {
        /// Latched [`Status`](crate::Status) bits of each damper.
        status: PerDamper<u16>,
        /// For each damper, the number of ticks with a held or limited displacement or a restart, up to 65535.
        rejected_inputs: PerDamper<u16>,
    },
    /// The request was refused and nothing changed.
    Refused(Refusal),
    /// Answers health and clear health.
    Health(HealthReading),
}

/// Description of a device and its dampers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Welcome<'a> {
    /// [`PROTOCOL`](super::PROTOCOL) of the device.
    pub protocol: u16,
    /// Version of dashpot-core in the device.
    pub core_version: &'a str,
    /// [`Damper::revision`](crate::Damper) of each loaded damper.
    pub revisions: PerDamper<u32>,
    /// Type of displacement, force and state.
    pub scalar: Scalar,
    /// Step of all dampers (s).
    pub step_s: f32,
    /// Bytes of a damper's image.
    pub image_bytes: u32,
    /// Last tick.
    pub tick: u32,
    /// Rate of the clock behind [`Forces::clock_ticks`] (Hz).
    pub clock_hz: u32,
    /// True while the device is free-running.
    pub running: bool,
}

/// Floating-point type of a device's dampers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Scalar {
    /// Single precision.
    #[default]
    F32,
    /// Double precision.
    F64,
}

/// Result of a tick.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Forces {
    /// Tick count.
    pub tick: u32,
    /// Output of each damper (N), positive when it resists extension.
    pub forces_n: Reals,
    /// Latched [`Status`](crate::Status) bits of each damper.
    pub status: PerDamper<u16>,
    /// Duration of stepping the bank in clock ticks.
    pub clock_ticks: u32,
}

/// Counters since power on. Each saturates at its largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Counters {
    /// Requests carried out.
    pub accepted: u32,
    /// Corrupt frames: wrong framing, length or CRC-32.
    pub corrupt: u32,
    /// Intact frames without a request of this protocol.
    pub unreadable: u32,
    /// Requests of a session that is not open.
    pub no_session: u32,
    /// Repeated requests: answered again, but not carried out again.
    pub repeated: u32,
    /// Requests out of sequence.
    pub out_of_order: u32,
    /// Refused requests among those in sequence.
    pub refused: u32,
    /// Free-running ticks that had not started when the next was due.
    pub overruns: u32,
    /// Losses of the link.
    pub link_losses: u32,
    /// Dampers and states found damaged in memory.
    pub corruptions: u32,
}

impl Counters {
    /// All counters at zero.
    pub(crate) const NONE: Self = Self {
        accepted: 0,
        corrupt: 0,
        unreadable: 0,
        no_session: 0,
        repeated: 0,
        out_of_order: 0,
        refused: 0,
        overruns: 0,
        link_losses: 0,
        corruptions: 0,
    };
}
