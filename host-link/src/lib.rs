#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod a2l;
mod bank;
mod child;
mod client;
mod desk;
mod emulator_error;
mod fault;
mod fault_counts;
mod health;
mod hold;
mod host_replica;
mod link;
mod link_choice;
mod link_error;
mod pace;
mod qemu;
mod record;
mod report;
mod retry_limits;
#[cfg(feature = "serial")]
mod serial;
mod session;
mod session_error;
mod tcp;
pub mod xcp;

pub use bank::Bank;
#[cfg(unix)]
pub use child::end_all as end_children;
pub use client::{Client, LinkFaults};
pub use desk::Desk;
pub use emulator_error::EmulatorError;
pub use fault::{FaultRates, FaultyLink};
pub use fault_counts::FaultCounts;
pub use health::HealthSample;
pub use hold::{Hold, MissingAnswers};
pub use link::Link;
pub use link_choice::LinkChoice;
pub use link_error::LinkError;
pub use pace::Pace;
pub use qemu::{DEFAULT_IMAGE, Qemu};
pub use record::{Event, TickRecord};
pub use report::{Cost, Mismatch, Pacing, Report, Target};
pub use retry_limits::RetryLimits;
#[cfg(feature = "serial")]
pub use serial::Serial;
pub use session::Session;
pub use session_error::SessionError;
pub use tcp::Tcp;
