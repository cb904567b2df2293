//! Parts shared by the images: bank of dampers, board, outputs and safe state.
#![no_std]

pub mod bank;
pub mod board;
#[cfg(not(feature = "nucleo-h753zi"))]
pub mod counted_call;
pub mod outputs;
pub mod printer;
pub mod safe_state;
