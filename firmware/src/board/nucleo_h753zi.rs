//! ST's NUCLEO-H753ZI (UM2407) with an STM32H753ZI; numbers of chapters are those of its reference manual RM0433.

use dashpot_core::link::{Clock, Line};

use super::{read, write};

/// Clock of processor, cycle counter and SysTick (Hz).
pub const CLOCK_HZ: u32 = 400_000_000;
/// Clock of the UARTs (Hz).
const UART_CLOCK_HZ: u32 = 100_000_000;

const FLASH_ACR: usize = 0x5200_2000;
const PWR_CSR1: usize = 0x5802_4804;
const PWR_CR3: usize = 0x5802_480c;
const PWR_D3CR: usize = 0x5802_4818;
const RCC_CR: usize = 0x5802_4400;
const RCC_CFGR: usize = 0x5802_4410;
const RCC_D1CFGR: usize = 0x5802_4418;
const RCC_D2CFGR: usize = 0x5802_441c;
const RCC_D3CFGR: usize = 0x5802_4420;
const RCC_PLLCKSELR: usize = 0x5802_4428;
const RCC_PLLCFGR: usize = 0x5802_442c;
const RCC_PLL1DIVR: usize = 0x5802_4430;
const RCC_AHB4ENR: usize = 0x5802_44e0;
const RCC_APB1LENR: usize = 0x5802_44e8;
const RCC_APB2ENR: usize = 0x5802_44f0;

const GPIOD: usize = 0x5802_0c00;
const GPIOG: usize = 0x5802_1800;
/// Two bits for each pin; 2 is an alternate function.
const GPIO_MODE: usize = 0x00;
/// Alternate functions of pins 8 to 15, four bits each.
const GPIO_FUNCTIONS: usize = 0x24;

const UART_CONTROL: usize = 0x00;
/// FIFO, transmitter, receiver, enable (CR1, 48.7.1).
const UART_RUNS: u32 = 1 << 29 | 1 << 3 | 1 << 2 | 1;
const UART_BAUD_DIVISOR: usize = 0x0c;
const UART_STATE: usize = 0x1c;
/// Bytes were lost; no more are received until this is cleared (ORE).
const UART_OVERRUN: u32 = 1 << 3;
const UART_HAS_RECEIVED: u32 = 1 << 5;
const UART_HAS_ROOM: u32 = 1 << 7;
const UART_CLEAR: usize = 0x20;
const UART_RECEIVED: usize = 0x24;
const UART_SEND: usize = 0x28;

const IWDG1_KEY: usize = 0x5800_4800;
const IWDG1_PRESCALER: usize = 0x5800_4804;
const IWDG1_RELOAD: usize = 0x5800_4808;
const IWDG1_STATE: usize = 0x5800_480c;
const DBGMCU_APB4FZ1: usize = 0x5c00_1054;

/// Registers of the processor (Armv7-M Architecture Reference Manual, chapters B3 and C1).
const SCB_CCR: usize = 0xe000_ed14;
const SCB_ICIALLU: usize = 0xe000_ef50;
const DCB_DEMCR: usize = 0xe000_edfc;
const DWT_CTRL: usize = 0xe000_1000;
const DWT_CYCCNT: usize = 0xe000_1004;
const DWT_LAR: usize = 0xe000_1fb0;

/// UARTs of the board, with the addresses of their registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// USART3 at the ST-LINK's virtual COM port: the link. TX is PD8, RX is PD9.
    Link = 0x4000_4800,
    /// USART6: the outputs. TX is PG14, D1 of the Arduino connector.
    Outputs = 0x4001_1400,
}

/// A serial line with 8 data bits and no parity. It has a FIFO of 16 bytes in each direction.
#[derive(Debug)]
pub struct Uart(usize);

impl Uart {
    /// Starts the UART of a port at `baud` bits per second, up to 6.25 million. One that runs already goes on.
    pub fn start(port: Port, baud: u32) -> Self {
        let base = port as usize;
        if read(base + UART_CONTROL) != UART_RUNS {
            write(
                base + UART_BAUD_DIVISOR,
                (UART_CLOCK_HZ / baud.max(1)).max(16),
            );
            write(base + UART_CONTROL, UART_RUNS);
        }
        Self(base)
    }
}

impl Line for Uart {
    #[inline]
    fn receive(&mut self) -> Option<u8> {
        let state = read(self.0 + UART_STATE);
        if state & UART_OVERRUN != 0 {
            write(self.0 + UART_CLEAR, UART_OVERRUN);
        }
        (state & UART_HAS_RECEIVED != 0).then(|| read(self.0 + UART_RECEIVED) as u8)
    }

    #[inline]
    fn send(&mut self, byte: u8) -> bool {
        let ready = read(self.0 + UART_STATE) & UART_HAS_ROOM != 0;
        if ready {
            write(self.0 + UART_SEND, u32::from(byte));
        }
        ready
    }
}

/// Starts the clocks, the pins and the instruction cache.
pub fn start() {
    write(SCB_ICIALLU, 0);
    barrier();
    set(SCB_CCR, 1 << 17);
    barrier();
    start_clocks();
    set(RCC_AHB4ENR, 1 << 3 | 1 << 6);
    set(RCC_APB1LENR, 1 << 18);
    set(RCC_APB2ENR, 1 << 5);
    // The peripherals have their clocks after a read (8.5.10).
    read(RCC_APB2ENR);
    for (pins, pin, function) in [(GPIOD, 8, 7), (GPIOD, 9, 7), (GPIOG, 14, 7)] {
        change(
            pins + GPIO_FUNCTIONS,
            0xf << (4 * (pin - 8)),
            function << (4 * (pin - 8)),
        );
        change(pins + GPIO_MODE, 3 << (2 * pin), 2 << (2 * pin));
    }
}

/// 400 MHz for the processor, 200 MHz for the buses and 100 MHz for the UARTs, all from the 8 MHz that the ST-LINK
/// supplies.
fn start_clocks() {
    // The regulator is the LDO (6.8.4); voltage range 1 (6.8.6).
    change(PWR_CR3, 0b111, 0b110);
    wait_for(PWR_CSR1, 1 << 13, 1 << 13);
    set(PWR_D3CR, 3 << 14);
    wait_for(PWR_D3CR, 1 << 13, 1 << 13);

    // A clock comes from outside, not from a crystal (8.7.2).
    set(RCC_CR, 1 << 18);
    set(RCC_CR, 1 << 16);
    wait_for(RCC_CR, 1 << 17, 1 << 17);

    // PLL1: 8 MHz by 1, times 100, by 2; input of 8 to 16 MHz, wide VCO (8.7.11 to 8.7.13).
    write(RCC_PLLCKSELR, 1 << 4 | 2);
    write(RCC_PLLCFGR, 1 << 16 | 3 << 2);
    write(RCC_PLL1DIVR, (2 - 1) << 9 | (100 - 1));
    set(RCC_CR, 1 << 24);
    wait_for(RCC_CR, 1 << 25, 1 << 25);

    // Flash at 200 MHz: two wait states, signal delay 2 (4.3.8).
    write(FLASH_ACR, 2 << 4 | 2);
    wait_for(FLASH_ACR, 0x37, 2 << 4 | 2);

    // Half the clock for AHB, and half of that for each APB (8.7.6 to 8.7.8); then PLL1 is the system's clock (8.7.5).
    write(RCC_D1CFGR, 4 << 4 | 8);
    write(RCC_D2CFGR, 4 << 8 | 4 << 4);
    write(RCC_D3CFGR, 4 << 4);
    change(RCC_CFGR, 7, 3);
    wait_for(RCC_CFGR, 7 << 3, 3 << 3);
}

/// Starts the watchdog, which resets the board 100 ms after it was last fed. A halted debugger stops it.
pub fn start_watchdog() {
    set(DBGMCU_APB4FZ1, 1 << 18);
    write(IWDG1_KEY, 0xcccc);
    write(IWDG1_KEY, 0x5555);
    // A quarter of the slow oscillator's 32 kHz.
    write(IWDG1_PRESCALER, 0);
    write(IWDG1_RELOAD, 800);
    wait_for(IWDG1_STATE, u32::MAX, 0);
    feed_watchdog();
}

/// Starts the time of the watchdog again.
pub fn feed_watchdog() {
    write(IWDG1_KEY, 0xaaaa);
}

/// Starts the clock that [`clock_now`] reads: the cycle counter of the processor.
pub fn start_clock() -> Clock {
    set(DCB_DEMCR, 1 << 24);
    write(DWT_LAR, 0xc5ac_ce55);
    write(DWT_CYCCNT, 0);
    set(DWT_CTRL, 1);
    Clock::new(clock_now, CLOCK_HZ)
}

/// Number of clock ticks at [`CLOCK_HZ`] since the start; it wraps.
pub fn clock_now() -> u32 {
    read(DWT_CYCCNT)
}

fn barrier() {
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}

fn set(register: usize, bits: u32) {
    write(register, read(register) | bits);
}

fn change(register: usize, mask: u32, bits: u32) {
    write(register, read(register) & !mask | bits);
}

fn wait_for(register: usize, mask: u32, bits: u32) {
    while read(register) & mask != bits {}
}
