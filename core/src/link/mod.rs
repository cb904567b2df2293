//! A bank of dampers served over a serial link: commissioning and processor-in-the-loop.
//!
//! Messages are postcard, frames are COBS with a CRC-32; docs/link.md has the tables and the rules. All
//! of it is independent of the processor: firmware adds a UART, a tick and a clock.
//!
//! A state moves only by a whole, readable request of the open session, in sequence, with the next tick.
//! Anything else is counted and answered.

mod device;
mod frame;
mod loaded;
mod loading;
mod message;
mod safe_output;
mod service;
mod session;

pub use device::Device;
pub use frame::{FRAME_BYTES, Frame, FrameError, FrameReader, MESSAGE_BYTES, Message};
pub use loaded::bank_revision;
pub use message::{
    CHUNK_BYTES, Counters, Forces, Header, MOST_DAMPERS, MOST_SAMPLES, PROTOCOL, Parameter, Reals,
    Refusal, Request, Response, Sample, Scalar, Welcome,
};
pub use safe_output::{LossOfLink, SafeOutput};
pub use service::Clock;
