//! Processor in the loop: the host drives a bank of dampers on a target over the link of
//! [`dashpot_core::link`] and compares every force with its own core, bit for bit.

mod bank;
mod client;
mod desk;
mod emulator_error;
mod fault;
mod health;
mod host_replica;
mod link;
mod link_error;
mod pace;
mod qemu;
mod record;
mod report;
#[cfg(feature = "serial")]
mod serial;
mod session;
mod session_error;
mod tcp;

pub use bank::Bank;
pub use client::{Client, LinkFaults, RetryLimits};
pub use desk::Desk;
pub use emulator_error::EmulatorError;
pub use fault::{FaultCounts, FaultRates, FaultyLink};
pub use link::{Link, LinkChoice};
pub use link_error::LinkError;
pub use pace::Pace;
pub use qemu::{DEFAULT_IMAGE, Qemu};
pub use record::{Event, TickRecord};
pub use report::{Cost, Mismatch, Pacing, Report, Target};
#[cfg(feature = "serial")]
pub use serial::Serial;
pub use session::Session;
pub use session_error::SessionError;
pub use tcp::Tcp;
