//! Real time on the host: ticks at a fixed rate, time spans and how they are spread, the budget of a step.

pub mod budget;
mod error;
pub mod handover;
pub mod pacing;
pub mod timing;

pub use error::RealtimeError;
pub(crate) use error::{listed, stopped};
