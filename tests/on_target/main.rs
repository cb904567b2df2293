//! Tests on emulated processors: the step, the firmware and its outputs.

mod aarch64;
mod bare_interrupt;
mod firmware;
mod health;
mod hybrid;
mod no_panic;
mod outputs;
mod processors;
mod tcp;
mod xcp;
