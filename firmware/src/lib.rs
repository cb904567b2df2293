//! Parts shared by the images: bank of dampers, board, outputs and safe state.
#![no_std]

pub mod bank;
pub mod board;
#[cfg(not(feature = "nucleo-h753zi"))]
pub mod counted_call;
#[cfg(feature = "tcp")]
pub mod lan9118;
pub mod outputs;
pub mod printer;
pub mod safe_state;
pub mod serving;
