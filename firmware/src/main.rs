//! The bank behind the serial link.
//!
//! One loop owns the device: it runs the ticks that SysTick counted, then moves one byte of the link.
//! Nothing waits, so a tick is late by at most the longest request, and that is counted.
#![no_std]
#![no_main]

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use dashpot_core::link::Device;
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::outputs;

const BAUD: u32 = 1_000_000;

/// Ticks due and not yet run.
static DUE: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    DUE.fetch_add(1, Ordering::Relaxed);
}

#[entry]
fn main() -> ! {
    let mut device = Device::<DAMPERS>::new(&BANK, board::start_clock());
    if let Some(mut core) = cortex_m::Peripherals::take() {
        let period = device.step_s() * CLOCK_HZ as f32 + 0.5;
        core.SYST.set_clock_source(SystClkSource::Core);
        core.SYST.set_reload(period as u32 - 1);
        core.SYST.clear_current();
        core.SYST.enable_counter();
        core.SYST.enable_interrupt();
    }
    let mut uart = Uart::start(Port::Link, BAUD);
    // Bytes of the response still to send, from the end.
    let mut left = 0;
    loop {
        let due = DUE.swap(0, Ordering::Relaxed);
        if due > 0 {
            device.tick(due);
            outputs::drive(device.outputs_n());
        }
        let response = device.response();
        if let Some(byte) = response.get(response.len().wrapping_sub(left)) {
            left -= usize::from(uart.send(*byte));
        } else if let Some(byte) = uart.receive()
            && device.receive(byte)
        {
            left = device.response().len();
            outputs::drive(device.outputs_n());
        }
    }
}
