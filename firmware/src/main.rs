//! A bank of dampers behind a serial link.
//!
//! One loop owns the device. It runs the ticks that SysTick counted, then does one thing for the link. Nothing blocks,
//! so the longest request bounds the delay of a tick; overruns are counted. The watchdog is fed while ticks run.
#![no_std]
#![no_main]

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m_rt::{entry, exception};
use dashpot_core::link::Device;
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::safe_state;
use static_cell::ConstStaticCell;

const BAUD: u32 = 1_000_000;

/// Number of ticks that are due but not yet run.
static DUE: AtomicU32 = AtomicU32::new(0);

/// All bits are zero before the start, so the device takes no flash. It is never moved.
static DEVICE: ConstStaticCell<Device<DAMPERS, DAMPERS>> = ConstStaticCell::new(Device::new());

#[exception]
fn SysTick() {
    DUE.fetch_add(1, Ordering::Relaxed);
}

#[entry]
fn main() -> ! {
    board::start();
    let Some(device) = DEVICE.try_take() else {
        safe_state::halt();
    };
    // Hides the address from the compiler. If the compiler knows the address, each access takes two instructions more
    // than with an offset from a pointer.
    let device = core::hint::black_box(device);
    if device.start(&BANK, board::start_clock()).is_err() {
        safe_state::halt();
    }
    if let Some(mut core) = cortex_m::Peripherals::take() {
        board::start_ticks(&mut core.SYST, device.step_s());
    }
    let mut link = Uart::start(Port::Link, BAUD);
    let mut outputs = SerialOutputs::start();
    board::start_watchdog();
    loop {
        let due = DUE.swap(0, Ordering::Relaxed);
        device.poll(due, &mut link, &mut outputs);
        if due > 0 {
            board::feed_watchdog();
        }
        outputs.send_waiting();
    }
}
