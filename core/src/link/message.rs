//! The messages: what a host asks and a device answers, postcard on the wire.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::refusal::Refusal;
use super::safe_output::LossOfLink;
use crate::health::HealthReading;

/// Version of the messages; changes whenever the bytes of one do. Messages are added behind the others without it: a
/// device that does not have one answers [`Refusal::Unreadable`].
pub const PROTOCOL: u16 = 3;
/// Dampers a device may hold.
pub const MOST_DAMPERS: usize = 16;
/// Telemetry samples in one response at most.
pub const MOST_SAMPLES: usize = 8;
/// Measured samples in one request at most.
pub const MOST_MEASURED: usize = 8;
/// Bytes of a measured sample.
pub const MEASURED_BYTES: usize = 8;

/// One number for each damper, in order of the dampers.
pub type Reals = Vec<f32, MOST_DAMPERS>;

/// What stands before every request and, given back, before its response.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Chosen by the host when it says hello.
    pub session: u16,
    /// Grows by one with every request of a session and wraps; a repeated request keeps its number.
    pub sequence: u32,
}

/// What a host asks. Displacements (m) are positive in extension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Request<'a> {
    /// Opens the session of the header. Moves no state.
    Hello {
        /// [`PROTOCOL`] of the host.
        protocol: u16,
    },
    /// Checks an image and puts its damper in the place of another; the state's force is kept.
    Load {
        /// Which damper, from 0.
        damper: u8,
        /// [`Damper::to_image`](crate::Damper), whole.
        image: &'a [u8],
    },
    /// Changes one parameter of one damper at once.
    Set {
        /// Which damper, from 0.
        damper: u8,
        /// Which parameter.
        parameter: Parameter,
        /// Its value, in the unit of its name.
        value: f32,
    },
    /// What happens when the link is lost.
    LossOfLink(LossOfLink),
    /// Puts every damper at rest at these displacements; tick 0.
    Reset {
        /// One a damper (m).
        displacements_m: Reals,
    },
    /// Steps every damper once.
    Step {
        /// Tick of these displacements: the last tick and one.
        tick: u32,
        /// One a damper (m).
        displacements_m: Reals,
    },
    /// Starts the free-running tick with every damper at rest at these displacements; ends a loss of
    /// link.
    Run {
        /// One a damper (m).
        displacements_m: Reals,
    },
    /// Displacements of the free-running ticks from now on.
    Displace {
        /// One a damper (m).
        displacements_m: Reals,
    },
    /// Ends the free-running tick.
    Stop,
    /// Asks for the states of all dampers.
    Save,
    /// Gives all dampers their states back, or none.
    Restore {
        /// Tick of the states.
        tick: u32,
        /// [`DamperState::to_bytes`](crate::DamperState) of each damper, in order.
        states: &'a [u8],
    },
    /// Takes the oldest samples of a damper not yet taken; those of others stay.
    Telemetry {
        /// Which damper, from 0.
        damper: u8,
    },
    /// Asks for the counters.
    Counters,
    /// Asks what the outputs are now.
    Outputs,
    /// Asks for status bits and rejected inputs.
    Status,
    /// Clears status bits and rejected inputs of every damper; the answer has what was cleared.
    ClearStatus,
    /// Checks a model of health and begins an estimate of the damper in a place with it.
    LoadHealth {
        /// Which damper, from 0.
        damper: u8,
        /// [`HealthModel::to_image`](crate::health::HealthModel::to_image), whole.
        image: &'a [u8],
    },
    /// Samples of a real damper for the estimate of its health, one a step.
    Measure {
        /// Which damper, from 0.
        damper: u8,
        /// Of each sample displacement (m) and force (N), little-endian in single precision; [`MOST_MEASURED`] at most.
        samples: &'a [u8],
    },
    /// Asks for the health of a damper.
    Health {
        /// Which damper, from 0.
        damper: u8,
    },
    /// Clears status bits and rejected samples of a damper's health; the answer has what was cleared.
    ClearHealth {
        /// Which damper, from 0.
        damper: u8,
    },
}

/// Parameters by their key in a damper file. Only the clearance can change without a rebuild.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Parameter {
    /// `mount.clearance_m`: 2a, the whole play.
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

/// What a device answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Response<'a> {
    /// To hello.
    #[serde(borrow)]
    Welcome(Welcome<'a>),
    /// Done as asked.
    Done,
    /// To step, run and displace.
    Forces(Forces),
    /// To save.
    Saved {
        /// Last tick.
        tick: u32,
        /// [`DamperState::to_bytes`](crate::DamperState) of each damper, in order.
        states: &'a [u8],
    },
    /// To telemetry.
    Telemetry {
        /// Samples of the damper lost to newer ones before they were taken.
        overwritten: u32,
        /// Oldest first.
        samples: Vec<Sample, MOST_SAMPLES>,
    },
    /// To counters.
    Counters(Counters),
    /// To outputs.
    Outputs {
        /// What the outputs were set to last (N).
        outputs_n: Reals,
    },
    /// To status and clear status.
    Status {
        /// Latched [`Status`](crate::Status) bits of each damper.
        status: Vec<u16, MOST_DAMPERS>,
        /// Ticks of each damper whose displacement was held or limited, up to 65535.
        rejected_inputs: Vec<u16, MOST_DAMPERS>,
    },
    /// Not done; nothing changed.
    Refused(Refusal),
    /// To health and clear health.
    Health(HealthReading),
}

/// Who answers, and what it holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Welcome<'a> {
    /// [`PROTOCOL`] of the device.
    pub protocol: u16,
    /// Version of dashpot-core in the device.
    pub core_version: &'a str,
    /// [`Damper::revision`](crate::Damper) of each damper loaded now.
    pub revisions: Vec<u32, MOST_DAMPERS>,
    /// Type of displacement, force and state.
    pub scalar: Scalar,
    /// Step of every damper (s).
    pub step_s: f32,
    /// Bytes of a damper's image.
    pub image_bytes: u32,
    /// Last tick.
    pub tick: u32,
    /// Rate of the clock behind [`Forces::clock_ticks`] (Hz).
    pub clock_hz: u32,
    /// Whether the tick runs free.
    pub running: bool,
}

/// Floating-point type of a device's dampers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Scalar {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

/// A tick's result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Forces {
    /// The tick.
    pub tick: u32,
    /// Output of each damper (N), positive when it resists extension.
    pub forces_n: Reals,
    /// Latched [`Status`](crate::Status) bits of each damper.
    pub status: Vec<u16, MOST_DAMPERS>,
    /// Clock ticks that stepping the bank took.
    pub clock_ticks: u32,
}

/// A tick of the recorded damper.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Tick count.
    pub tick: u32,
    /// Displacement used (m).
    pub displacement_m: f32,
    /// Force returned (N).
    pub force_n: f32,
    /// Latched [`Status`](crate::Status) bits.
    pub status: u16,
}

/// What happened since power on; each stops at its largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Requests carried out.
    pub accepted: u32,
    /// Frames broken on the way: framing, length or CRC-32.
    pub corrupt: u32,
    /// Whole frames that hold no request of this protocol.
    pub unreadable: u32,
    /// Requests of a session that is not open.
    pub no_session: u32,
    /// Requests received again, answered again, not carried out again.
    pub repeated: u32,
    /// Requests out of sequence.
    pub out_of_order: u32,
    /// Requests in sequence that were refused.
    pub refused: u32,
    /// Free-running ticks that had not begun when the next was due.
    pub overruns: u32,
    /// Losses of the link.
    pub link_losses: u32,
    /// Dampers and states found damaged in memory.
    pub corruptions: u32,
}

impl Counters {
    /// Nothing happened.
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
