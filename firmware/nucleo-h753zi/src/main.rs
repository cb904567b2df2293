//! A bank of dampers behind a link on ST's board NUCLEO-H753ZI (docs/board.md).
//!
//! One task owns the device: it runs the ticks that SysTick counted and serves the link. Another sends the outputs, and
//! the main task feeds the watchdog while ticks and link make progress.
#![no_std]
#![no_main]

mod bank;
mod board;
mod in_service;
mod line;
mod outputs;
#[cfg(feature = "ethernet")]
mod phy;
mod safe_state;
mod server;

use bank::{BANK, DAMPERS};
use cortex_m_rt::exception;
use dashpot_core::link::Device;
use dashpot_device::{Progress, ProgressCheck, Ticks};
use embassy_executor::Spawner;
use embassy_time::Timer;
use outputs::SerialOutputs;
use server::BankServer;
use static_cell::ConstStaticCell;

/// Time between two looks at the progress, a fifth of the watchdog's time (ms).
const LOOK_MS: u64 = 20;

static TICKS: Ticks = Ticks::new();
static PROGRESS: Progress = Progress::new();

/// All bits are zero before the start, so the device takes no flash. It is never moved.
static DEVICE: ConstStaticCell<Device<DAMPERS, DAMPERS>> = ConstStaticCell::new(Device::new());

#[exception]
fn SysTick() {
    TICKS.count();
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    rtt_target::rtt_init_log!(log::LevelFilter::Info);
    let (Ok(board), Some(mut core)) = (board::start(), cortex_m::Peripherals::take()) else {
        safe_state::halt();
    };
    if board.was_reset_by_watchdog {
        log::warn!("the watchdog reset the board");
    }
    let device = DEVICE.take();
    if device.start(&BANK, board::start_clock(&mut core)).is_err() {
        safe_state::halt();
    }
    board::start_ticks(&mut core, device.step_s());
    log::info!("{DAMPERS} dampers, a tick of {} s", device.step_s());

    let server = BankServer {
        device,
        outputs: SerialOutputs,
        ticks: &TICKS,
        progress: &PROGRESS,
    };
    let (Ok(outputs), Ok(())) = (
        outputs::send(board.outputs),
        line::start(spawner, server, board.line),
    ) else {
        safe_state::halt();
    };
    spawner.spawn(outputs);

    let mut watchdog = board.watchdog;
    watchdog.unleash();
    let mut check = ProgressCheck::default();
    loop {
        Timer::after_millis(LOOK_MS).await;
        if check.both_moved(&PROGRESS) {
            watchdog.pet();
        }
    }
}
