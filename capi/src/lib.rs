//! C library of the Dashpot damper; `include/dashpot.h` is generated from the functions here.
//!
//! `functions` is all that C sees, `pointer` checks what C hands in, `saved` is a state as bytes. Single
//! precision only: that is what the library is for; on a desk use dashpot-core.
#![no_std]
#![warn(missing_docs)]

mod error;
mod functions;
mod pointer;
mod saved;
mod types;

pub use error::{DashpotError, dashpot_error_text};
pub use functions::*;
pub use types::*;

#[cfg(feature = "panic-handler")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
