//! What the images share: the bank of dampers, the board, the outputs and the safe state.
#![no_std]

pub mod bank;
pub mod board;
pub mod outputs;
mod safe_state;
