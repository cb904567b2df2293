//! Slave of the measurement and calibration protocol XCP (ASAM MCD-1 XCP), without sockets, clocks or allocation.
//!
//! [`Slave`] executes the commands of a master and samples DAQ lists. What it measures and calibrates is a [`Memory`].
//! The transport passes whole packets: [`ethernet`] has the header of a message on UDP and TCP.
//!
//! The slave speaks version 1.1 of the protocol layer, little-endian, with byte addresses, dynamic DAQ lists, time
//! stamps of 1 us in 4 bytes and one calibration segment. Masters of later versions speak with it too.
//!
//! ```
//! use dashpot_core::xcp::{Address, ErrorCode, Memory, Slave};
//!
//! struct Answer([u8; 4]);
//! impl Memory for Answer {
//!     fn read(&self, address: Address, into: &mut [u8]) -> Result<(), ErrorCode> {
//!         let start = address.offset as usize;
//!         let bytes = self.0.get(start..start + into.len());
//!         into.copy_from_slice(bytes.ok_or(ErrorCode::AccessDenied)?);
//!         Ok(())
//!     }
//! }
//! let mut memory = Answer(42_u32.to_le_bytes());
//! let mut slave: Slave<1, 1, 1, 64> = Slave::new();
//! // CONNECT, then SHORT_UPLOAD of four bytes from address 0.
//! assert!(slave.receive(&[0xFF, 0], &mut memory).is_some());
//! let response = slave.receive(&[0xF4, 4, 0, 0, 0, 0, 0, 0], &mut memory);
//! assert_eq!(response.as_deref(), Some(&[0xFF, 42, 0, 0, 0][..]));
//! ```

mod calibration;
mod daq;
mod daq_commands;
mod error;
pub mod ethernet;
mod memory;
mod mta;
mod packet;
mod protocol;
mod sampling;
mod slave;
mod transfer;

pub use error::ErrorCode;
pub use memory::{Address, Event, Memory, Page, Segment, Text};
pub use packet::Response;
pub use protocol::{Command, EV_DAQ_OVERLOAD, EV_SESSION_TERMINATED, EVENT_PACKET, MAX_CTO};
pub use slave::Slave;
