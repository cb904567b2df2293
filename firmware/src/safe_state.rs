//! The safe state after a panic or a fault: outputs are zero, nothing runs and the host gets no answer.

use core::panic::PanicInfo;

use cortex_m_rt::exception;

use crate::outputs;

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
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
        cortex_m::asm::wfi();
    }
}
