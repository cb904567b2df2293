//! The link's [`Device`](dashpot_core::link::Device) over any byte stream of `embedded-io`, for firmware of any board.
//!
//! A board brings a stream (UART, USB, TCP), a timer interrupt that calls [`Ticks::count`], and its outputs. On an
//! async executor, [`Server::serve`] does the rest; with the feature `tcp`, `Server::serve_tcp` takes one host after
//! the other. In a plain loop, [`Polled`] makes a stream the line of `Device::poll`. `firmware/nucleo-h753zi` is an
//! example.
#![no_std]

#[cfg(feature = "tcp")]
mod few_frames;
mod force_packet;
mod polled;
mod progress;
mod server;
#[cfg(feature = "tcp")]
mod tcp;
mod ticks;

#[cfg(feature = "tcp")]
pub use few_frames::FewFrames;
pub use force_packet::{ForcePacket, MARK};
pub use polled::Polled;
pub use progress::{Progress, ProgressCheck};
pub use server::Server;
pub use ticks::Ticks;
