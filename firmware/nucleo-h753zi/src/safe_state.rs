//! The safe state after a panic or a fault: outputs are zero and nothing runs until the watchdog resets the board. Then
//! outputs stay zero until a host starts a run.

use core::panic::PanicInfo;

use cortex_m_rt::exception;

use crate::outputs;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    cortex_m::interrupt::disable();
    outputs::zero();
    log::error!("{info}");
    halt()
}

// SAFETY: the handler accesses only the registers of the outputs, and nothing runs after it.
#[exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    halt()
}

// SAFETY: as for `HardFault`. No other exception or interrupt is expected.
#[exception]
unsafe fn DefaultHandler(_: i16) -> ! {
    halt()
}

/// Sets the outputs to zero and stops.
pub fn halt() -> ! {
    cortex_m::interrupt::disable();
    outputs::zero();
    loop {
        cortex_m::asm::nop();
    }
}
