//! Server of the measurement and calibration protocol XCP on Ethernet (UDP and TCP), for a model that runs in this
//! process.
//!
//! A thread of its own talks with the master. The thread that follows the model passes it the values of each tick
//! through a [`Feed`], and the thread that steps the model shares nothing with it, except in virtual time a [`Gate`].

mod feed;
mod gate;
mod image;
mod input;
mod outlet;
mod pacing;
mod parameters;
mod server;
mod serving;
mod sockets;
mod summary;

pub use feed::Feed;
pub use gate::Gate;
pub use image::Image;
pub use pacing::Pacing;
pub use parameters::{Fixed, Parameters};
pub use server::{Running, Server, ServerFailed};
pub use summary::Summary;

/// Largest packet of samples, bytes: with its headers it fits into an Ethernet frame.
pub const MAX_DTO: usize = 1400;

/// The slave, with room for 64 lists, 512 packets and 8192 entries.
pub type Slave = dashpot_core::xcp::Slave<64, 512, 8192, MAX_DTO>;
