//! C library of the Dashpot damper. `include/dashpot.h` is generated from these sources.
//!
//! Each function first checks all its arguments, then does its work or nothing. The library is for targets, so it has
//! single precision only. On a desktop use dashpot-core.
//!
//! The contract that the caller of every function keeps: a pointer that is neither null nor misaligned points to
//! storage of its type, or to as many bytes or elements as the length or count says. During the call nothing else
//! changes that storage, or uses storage that the call changes.
#![no_std]
#![warn(missing_docs)]
#![allow(clippy::missing_safety_doc)] // the contract above and the header are the safety documentation

mod check;
mod damper;
mod error;
mod health;
mod hybrid;
mod pointer;
mod state;
mod step;
mod types;
mod version;

pub use check::dashpot_check_slice;
pub use damper::{dashpot_damper_describe, dashpot_damper_init, dashpot_damper_set_clearance};
pub use error::{DashpotError, dashpot_error_text};
pub use health::{
    dashpot_health_clear_status, dashpot_health_init, dashpot_health_model_init,
    dashpot_health_read, dashpot_health_set_baseline, dashpot_health_set_limits,
    dashpot_health_tick,
};
pub use hybrid::*;
pub use state::{
    dashpot_state_clear_status, dashpot_state_init, dashpot_state_read, dashpot_state_restore,
    dashpot_state_save,
};
pub use step::{dashpot_step, dashpot_step_bank};
pub use types::*;
pub use version::{dashpot_check_header, dashpot_version};

#[cfg(feature = "panic-handler")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
