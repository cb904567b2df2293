//! The emulator's boards: CMSDK peripherals of the MPS2 (Arm DUI 0479, chapter 4).
//!
//! The board is the MPS2 with AN500 (Cortex-M7) or AN386 (Cortex-M4), or with AN505 for a Cortex-M33 (Arm DAI 0505,
//! chapter 3; secure addresses).

use dashpot_core::link::{Clock, Line};

use super::{read, write};

/// Clock of processor, timer and SysTick (Hz).
pub const CLOCK_HZ: u32 = if cfg!(mps2_an505) {
    20_000_000
} else {
    25_000_000
};

/// Address of the first UART. The other UARTs follow.
const UARTS: usize = if cfg!(mps2_an505) {
    0x5020_0000
} else {
    0x4000_4000
};

const UART_DATA: usize = 0x00;
/// Bit 0: transmitter full. Bit 1: received byte available.
const UART_STATE: usize = 0x04;
/// Bit 0: transmit. Bit 1: receive.
const UART_CONTROL: usize = 0x08;
/// Clocks per bit, at least 16.
const UART_BAUD_DIVISOR: usize = 0x10;

const TIMER0: usize = if cfg!(mps2_an505) {
    0x5000_0000
} else {
    0x4000_0000
};
/// Bit 0: enable counting.
const TIMER_CONTROL: usize = TIMER0;
/// Value of the timer, which counts down.
pub(crate) const TIMER_VALUE: usize = TIMER0 + 0x04;
const TIMER_RELOAD: usize = TIMER0 + 0x08;

const WATCHDOG: usize = if cfg!(mps2_an505) {
    0x5008_1000
} else {
    0x4000_8000
};
const WATCHDOG_LOAD: usize = WATCHDOG;
/// Bits 0 and 1: interrupt after the time, reset after the same time again.
const WATCHDOG_CONTROL: usize = WATCHDOG + 0x08;
const WATCHDOG_RESTART: usize = WATCHDOG + 0x0c;

/// UARTs of the board, with the addresses of their registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// UART0: the link.
    Link = UARTS as isize,
    /// UART1: the outputs.
    Outputs = UARTS as isize + 0x1000,
    /// UART2: unused.
    Spare = UARTS as isize + 0x2000,
}

/// A serial line with 8 data bits and no parity.
#[derive(Debug)]
pub struct Uart(usize);

impl Uart {
    /// Starts the UART of a port at `baud` bits per second, up to 1 562 500.
    pub fn start(port: Port, baud: u32) -> Self {
        let base = port as usize;
        write(base + UART_BAUD_DIVISOR, (CLOCK_HZ / baud.max(1)).max(16));
        write(base + UART_CONTROL, 0b11);
        Self(base)
    }
}

impl Line for Uart {
    #[inline]
    fn receive(&mut self) -> Option<u8> {
        let waits = read(self.0 + UART_STATE) & 0b10 != 0;
        waits.then(|| read(self.0 + UART_DATA) as u8)
    }

    #[inline]
    fn send(&mut self, byte: u8) -> bool {
        let ready = read(self.0 + UART_STATE) & 0b01 == 0;
        if ready {
            write(self.0 + UART_DATA, u32::from(byte));
        }
        ready
    }
}

/// Starts the clocks, which run already.
pub fn start() {}

/// Starts the watchdog: 50 ms after it was last fed an exception brings the outputs to their safe state, and 50 ms
/// later the board is reset.
pub fn start_watchdog() {
    write(WATCHDOG_LOAD, CLOCK_HZ / 20);
    write(WATCHDOG_CONTROL, 0b11);
}

/// Starts the time of the watchdog again.
pub fn feed_watchdog() {
    write(WATCHDOG_RESTART, 1);
}

/// Starts the clock that [`clock_now`] reads.
pub fn start_clock() -> Clock {
    write(TIMER_RELOAD, u32::MAX);
    write(TIMER_VALUE, u32::MAX);
    write(TIMER_CONTROL, 1);
    Clock::new(clock_now, CLOCK_HZ)
}

/// Number of clock ticks at [`CLOCK_HZ`] since the start; it wraps. The processor's cycle counter (DWT) would also
/// work, but QEMU does not have it.
pub fn clock_now() -> u32 {
    !read(TIMER_VALUE)
}
