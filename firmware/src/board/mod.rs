//! Clocks, UARTs, timer and watchdog of the board. For another board write a file like those here, and a `memory.x`.

#[cfg(all(feature = "mps2", feature = "nucleo-h753zi"))]
compile_error!("the image is for one board: build with --no-default-features");

#[cfg(not(feature = "nucleo-h753zi"))]
mod mps2;
#[cfg(feature = "nucleo-h753zi")]
mod nucleo_h753zi;

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
#[cfg(not(feature = "nucleo-h753zi"))]
pub use mps2::*;
#[cfg(feature = "nucleo-h753zi")]
pub use nucleo_h753zi::*;

/// Starts SysTick, which then interrupts once in each step of the dampers (s).
pub fn start_ticks(timer: &mut SYST, step_s: f32) {
    let period = step_s * CLOCK_HZ as f32 + 0.5;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(period as u32 - 1);
    timer.clear_current();
    timer.enable_counter();
    timer.enable_interrupt();
}

fn read(register: usize) -> u32 {
    // SAFETY: every address in this folder is a register of the board, word-aligned and always readable.
    unsafe { with_exposed_provenance::<u32>(register).read_volatile() }
}

fn write(register: usize, value: u32) {
    // SAFETY: as in `read`; no register written here affects memory.
    unsafe { with_exposed_provenance_mut::<u32>(register).write_volatile(value) }
}
