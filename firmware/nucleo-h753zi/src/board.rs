//! Clocks, serial lines, tick and watchdog of the board (UM2407). For another board change this file and `memory.x`.

use cortex_m::peripheral::DWT;
use cortex_m::peripheral::syst::SystClkSource;
use dashpot_core::link::Clock;
use embassy_stm32::mode::Async;
use embassy_stm32::peripherals::{DMA1_CH0, DMA1_CH1, DMA1_CH2, IWDG1, USART3};
use embassy_stm32::rcc::{
    AHBPrescaler, APBPrescaler, Hse, HseMode, Pll, PllDiv, PllMul, PllPreDiv, PllSource, Sysclk,
    VoltageScale,
};
use embassy_stm32::time::Hertz;
use embassy_stm32::usart::{self, ConfigError, RingBufferedUartRx, Uart, UartTx};
use embassy_stm32::wdg::IndependentWatchdog;
use embassy_stm32::{Config, bind_interrupts, dma, pac};
use static_cell::ConstStaticCell;

/// Clock of processor, SysTick and cycle counter (Hz).
pub const CLOCK_HZ: u32 = 400_000_000;

/// Bits per second of the link, the default of `dashpot link --baud`. The UART can do 12.5 million.
const LINK_BAUD: u32 = 1_000_000;

/// Bits per second of the outputs. A packet of 12 forces takes a third of a 1 ms tick.
const OUTPUTS_BAUD: u32 = 1_562_500;

/// The board is reset if the watchdog is not fed for this time (us).
const WATCHDOG_US: u32 = 100_000;

/// Bytes that DMA received while the device was at work: 40 ms at 1 Mbaud.
static RECEIVED: ConstStaticCell<[u8; 4096]> = ConstStaticCell::new([0; 4096]);

bind_interrupts!(struct Interrupts {
    USART3 => usart::InterruptHandler<USART3>;
    DMA1_STREAM0 => dma::InterruptHandler<DMA1_CH0>;
    DMA1_STREAM1 => dma::InterruptHandler<DMA1_CH1>;
    DMA1_STREAM2 => dma::InterruptHandler<DMA1_CH2>;
});

/// What the image uses of the board.
pub struct Board {
    /// USART3 at the ST-LINK's virtual COM port: TX on PD8, RX on PD9.
    pub link: (UartTx<'static, Async>, RingBufferedUartRx<'static>),
    /// USART6, TX on PG14 (D1 of the Arduino connector).
    pub outputs: UartTx<'static, Async>,
    /// Not started yet.
    pub watchdog: IndependentWatchdog<'static, IWDG1>,
    /// True if the watchdog caused the last reset.
    pub was_reset_by_watchdog: bool,
}

/// Starts clocks and serial lines.
///
/// # Errors
/// A rate cannot be made from the clocks.
pub fn start() -> Result<Board, ConfigError> {
    let p = embassy_stm32::init(clocks());
    let resets = pac::RCC.rsr().read();
    pac::RCC.rsr().modify(|flags| flags.set_rmvf(true));
    // A debugger that halts the processor must not cause a reset.
    pac::DBGMCU
        .apb4fzr1()
        .modify(|freeze| freeze.set_iwdg1(true));

    let link = Uart::new(
        p.USART3,
        p.PD9,
        p.PD8,
        p.DMA1_CH1,
        p.DMA1_CH0,
        Interrupts,
        at_baud(LINK_BAUD),
    )?;
    let (sender, receiver) = link.split();
    let outputs = UartTx::new(
        p.USART6,
        p.PG14,
        p.DMA1_CH2,
        Interrupts,
        at_baud(OUTPUTS_BAUD),
    )?;
    Ok(Board {
        link: (sender, receiver.into_ring_buffered(RECEIVED.take())),
        outputs,
        watchdog: IndependentWatchdog::new(p.IWDG1, WATCHDOG_US),
        was_reset_by_watchdog: resets.iwdg1rstf(),
    })
}

fn at_baud(baud: u32) -> usart::Config {
    let mut config = usart::Config::default();
    config.baudrate = baud;
    config
}

/// 400 MHz for the processor, 200 MHz for the buses, 100 MHz for UARTs and timers, all from the 8 MHz that the ST-LINK
/// supplies.
fn clocks() -> Config {
    let mut config = Config::default();
    config.rcc.hse = Some(Hse {
        freq: Hertz(8_000_000),
        mode: HseMode::Bypass,
    });
    config.rcc.pll1 = Some(Pll {
        source: PllSource::HSE,
        prediv: PllPreDiv::DIV1,
        mul: PllMul::MUL100,
        divp: Some(PllDiv::DIV2),
        divq: None,
        divr: None,
    });
    config.rcc.sys = Sysclk::PLL1_P;
    config.rcc.ahb_pre = AHBPrescaler::DIV2;
    config.rcc.apb1_pre = APBPrescaler::DIV2;
    config.rcc.apb2_pre = APBPrescaler::DIV2;
    config.rcc.apb3_pre = APBPrescaler::DIV2;
    config.rcc.apb4_pre = APBPrescaler::DIV2;
    config.rcc.voltage_scale = VoltageScale::Scale1;
    config
}

/// Starts the instruction cache and the cycle counter, and returns the counter. The data cache stays off: DMA does not
/// see it.
pub fn start_clock(core: &mut cortex_m::Peripherals) -> Clock {
    core.SCB.enable_icache();
    core.DCB.enable_trace();
    DWT::unlock();
    core.DWT.set_cycle_count(0);
    core.DWT.enable_cycle_counter();
    Clock::new(DWT::cycle_count, CLOCK_HZ)
}

/// Starts SysTick, once in each step of the dampers (s).
pub fn start_ticks(core: &mut cortex_m::Peripherals, step_s: f32) {
    let period = step_s * CLOCK_HZ as f32 + 0.5;
    core.SYST.set_clock_source(SystClkSource::Core);
    core.SYST.set_reload(period as u32 - 1);
    core.SYST.clear_current();
    core.SYST.enable_counter();
    core.SYST.enable_interrupt();
}
