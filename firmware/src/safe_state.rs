//! The safe state after a panic or a fault: outputs zero, nothing runs, the host gets no answer.

use core::panic::PanicInfo;

use cortex_m_rt::exception;

use crate::outputs;

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    halt()
}

// SAFETY: the handler touches nothing but the registers of the outputs, and nothing runs after it.
#[exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    halt()
}

// SAFETY: as above. Every other exception and interrupt: none is expected.
#[exception]
unsafe fn DefaultHandler(_: i16) -> ! {
    halt()
}

/// Outputs zero, then nothing.
pub fn halt() -> ! {
    cortex_m::interrupt::disable();
    outputs::zero();
    loop {
        cortex_m::asm::wfi();
    }
}
