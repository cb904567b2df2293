//! A bank of dampers served over a serial link: commissioning and processor-in-the-loop.
//!
//! Messages are encoded with postcard and framed with COBS and a CRC-32; docs/link.md has the tables and the rules. The
//! module does not depend on the processor: firmware adds a UART, a tick and a clock.
//!
//! A request changes a state only if it is intact, readable, part of the open session and in sequence; a step must also
//! name the next tick. The device counts and answers everything else.

mod board;
mod device;
mod exchange;
mod frame;
mod guard;
mod limits;
mod lists;
mod load;
mod loaded;
mod message;
mod recorder;
mod refusal;
mod safe_output;
mod service;
mod session;
mod slots;
mod watched;

pub use board::{Line, Outputs};
pub use device::{Device, NotWatched};
pub use frame::{
    Frame, FrameError, FrameReader, Message, REQUEST_BYTES, REQUEST_FRAME_BYTES, RESPONSE_BYTES,
    RESPONSE_FRAME_BYTES, RequestFrame, ResponseFrame, request_frame,
};
pub use limits::{MAX_DAMPERS, MAX_MEASURED, MAX_SAMPLES, MEASURED_BYTES, PROTOCOL};
pub use lists::{PerDamper, Reals, Sample, Samples};
pub use loaded::StepSizeError;
pub use message::{Counters, Forces, Header, Parameter, Request, Response, Scalar, Welcome};
pub use recorder::KEPT_TICKS;
pub use refusal::Refusal;
pub use safe_output::{LossOfLink, SafeOutput};
pub use service::Clock;
