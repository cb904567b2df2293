//! Clocks, lines, tick and watchdog of the board (UM2407). For another board change this file and `memory.x`.

use cortex_m::peripheral::DWT;
use cortex_m::peripheral::syst::SystClkSource;
use dashpot_core::link::Clock;
use embassy_stm32::mode::Async;
#[cfg(not(feature = "ethernet"))]
use embassy_stm32::peripherals::{DMA1_CH0, DMA1_CH1, USART3};
use embassy_stm32::peripherals::{DMA1_CH2, IWDG1};
#[cfg(feature = "ethernet")]
use embassy_stm32::peripherals::{ETH, ETH_SMA, RNG};
use embassy_stm32::rcc::{
    AHBPrescaler, APBPrescaler, Hse, HseMode, Pll, PllDiv, PllMul, PllPreDiv, PllSource, Sysclk,
    VoltageScale,
};
use embassy_stm32::time::Hertz;
use embassy_stm32::usart::{self, ConfigError, UartTx};
#[cfg(not(feature = "ethernet"))]
use embassy_stm32::usart::{RingBufferedUartRx, Uart};
use embassy_stm32::wdg::IndependentWatchdog;
use embassy_stm32::{Config, bind_interrupts, dma, pac};
#[cfg(feature = "ethernet")]
use embassy_stm32::{eth, rng, uid};
use static_cell::ConstStaticCell;

#[cfg(feature = "ethernet")]
use crate::phy::RarePhy;

/// Clock of processor, SysTick and cycle counter (Hz).
pub const CLOCK_HZ: u32 = 400_000_000;

/// Bits per second of the link, the default of `dashpot link --baud`. The UART can do 12.5 million.
#[cfg(not(feature = "ethernet"))]
const LINK_BAUD: u32 = 1_000_000;

/// TCP port of the link.
#[cfg(feature = "ethernet")]
pub const PORT: u16 = 5555;

/// Address of the board on the network, as of `dashpot link --link tcp:192.168.7.2:5555`. For an address from a DHCP
/// server write `embassy_net::Config::dhcpv4(Default::default())`; the log has the address.
#[cfg(feature = "ethernet")]
pub fn address() -> embassy_net::Config {
    embassy_net::Config::ipv4_static(embassy_net::StaticConfigV4 {
        address: embassy_net::Ipv4Cidr::new(embassy_net::Ipv4Address::new(192, 168, 7, 2), 24),
        gateway: None,
        dns_servers: Default::default(),
    })
}

/// Bits per second of the outputs. A packet of 12 forces takes a third of a 1 ms tick.
const OUTPUTS_BAUD: u32 = 1_562_500;

/// The board is reset if the watchdog is not fed for this time (us).
const WATCHDOG_US: u32 = 100_000;

/// Bytes that DMA received while the device was at work: 40 ms at 1 Mbaud.
#[cfg(not(feature = "ethernet"))]
static RECEIVED: ConstStaticCell<[u8; 4096]> = ConstStaticCell::new([0; 4096]);

/// Frames that the Ethernet's own DMA sends and receives: 8 while the device was at work. The DMA reaches the AXI SRAM.
#[cfg(feature = "ethernet")]
static FRAMES: ConstStaticCell<eth::PacketQueue<4, 8>> =
    ConstStaticCell::new(eth::PacketQueue::new());

/// The Ethernet controller with the chip at the connector.
#[cfg(feature = "ethernet")]
pub type NetworkCard = eth::Ethernet<'static, ETH, RarePhy<eth::Sma<'static, ETH_SMA>>>;

/// The network card, and a random number for the numbers of the connections.
#[cfg(feature = "ethernet")]
pub type Line = (NetworkCard, u64);

/// Both directions of the UART.
#[cfg(not(feature = "ethernet"))]
pub type Line = (UartTx<'static, Async>, RingBufferedUartRx<'static>);

bind_interrupts!(struct Interrupts {
    #[cfg(not(feature = "ethernet"))]
    USART3 => usart::InterruptHandler<USART3>;
    #[cfg(not(feature = "ethernet"))]
    DMA1_STREAM0 => dma::InterruptHandler<DMA1_CH0>;
    #[cfg(not(feature = "ethernet"))]
    DMA1_STREAM1 => dma::InterruptHandler<DMA1_CH1>;
    #[cfg(feature = "ethernet")]
    ETH => eth::InterruptHandler;
    #[cfg(feature = "ethernet")]
    HASH_RNG => rng::InterruptHandler<RNG>;
    DMA1_STREAM2 => dma::InterruptHandler<DMA1_CH2>;
});

/// What the image uses of the board.
pub struct Board {
    /// USART3 at the ST-LINK's virtual COM port (TX on PD8, RX on PD9), or the Ethernet connector.
    pub line: Line,
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

    #[cfg(not(feature = "ethernet"))]
    let line = {
        let uart = Uart::new(
            p.USART3,
            p.PD9,
            p.PD8,
            p.DMA1_CH1,
            p.DMA1_CH0,
            Interrupts,
            at_baud(LINK_BAUD),
        )?;
        let (sender, receiver) = uart.split();
        (sender, receiver.into_ring_buffered(RECEIVED.take()))
    };
    #[cfg(feature = "ethernet")]
    let line = {
        let card = eth::Ethernet::new_with_phy(
            FRAMES.take(),
            p.ETH,
            Interrupts,
            p.PA1,
            p.PA7,
            p.PC4,
            p.PC5,
            p.PG13,
            p.PB13,
            p.PG11,
            hardware_address(),
            RarePhy::new(eth::Sma::new(p.ETH_SMA, p.PA2, p.PC1)),
        );
        (card, rng::Rng::new(p.RNG, Interrupts).next_u64())
    };
    let outputs = UartTx::new(
        p.USART6,
        p.PG14,
        p.DMA1_CH2,
        Interrupts,
        at_baud(OUTPUTS_BAUD),
    )?;
    Ok(Board {
        line,
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

/// Address of the Ethernet controller: locally administered, from the number that ST gave this chip.
#[cfg(feature = "ethernet")]
fn hardware_address() -> [u8; 6] {
    let [x, y, _, _, a, b, c, d, ..] = uid::uid();
    [2, x ^ a, y ^ b, c, d, 0]
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
    // The clock of the random numbers.
    config.rcc.hsi48 = Some(Default::default());
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
