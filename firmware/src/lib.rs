//! What the images share: the bank of dampers, the board, the outputs and the safe state.
#![no_std]

pub mod bank;
pub mod board;
pub mod counted_call;
pub mod outputs;
pub mod printer;
pub mod safe_state;
