//! A bank of dampers served over a serial link: commissioning and processor-in-the-loop.
//!
//! Messages are postcard, frames are COBS with a CRC-32; docs/link.md has the tables and the rules. All
//! of it is independent of the processor: firmware adds a UART, a tick and a clock.
//!
//! A state moves only by a whole, readable request of the open session, in sequence, with the next tick.
//! Anything else is counted and answered.

mod board;
mod device;
mod exchange;
mod frame;
mod guard;
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
pub use device::Device;
pub use frame::{
    Frame, FrameError, FrameReader, Message, REQUEST_BYTES, REQUEST_FRAME_BYTES, RESPONSE_BYTES,
    RESPONSE_FRAME_BYTES, RequestFrame, ResponseFrame, request_frame,
};
pub use loaded::StepSizeError;
pub use message::{
    Counters, Forces, Header, MEASURED_BYTES, MOST_DAMPERS, MOST_MEASURED, MOST_SAMPLES, PROTOCOL,
    Parameter, Reals, Request, Response, Sample, Scalar, Welcome,
};
pub use recorder::KEPT_TICKS;
pub use refusal::Refusal;
pub use safe_output::{LossOfLink, SafeOutput};
pub use service::Clock;
