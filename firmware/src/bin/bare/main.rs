//! A bank of dampers without a link and without an executor: the SysTick interrupt steps the dampers, and the main loop
//! sends the forces to the outputs, prints a line each 100 ms and feeds the watchdog. `firmware/c` is the same in C.
#![no_std]
#![no_main]

mod rig;
mod tick;

use core::cell::Cell;
use core::fmt::Write;

use cortex_m::interrupt::{Mutex, free};
use cortex_m_rt::{entry, exception};
use dashpot_core::link::{Line, Outputs};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::safe_state;
use heapless::String;
use tick::{Report, Tick};

const BAUD: u32 = 1_000_000;
/// Period of SysTick, for which the dampers are made (s).
const STEP_S: f32 = 1e-3;
/// Ticks between two reports.
const REPORT_EVERY: u32 = 100;

/// The last forces (N) that the main loop has not taken yet.
static FORCES_N: Mutex<Cell<Option<[f32; DAMPERS]>>> = Mutex::new(Cell::new(None));
/// A report that the main loop has not taken yet.
static REPORT: Mutex<Cell<Option<Report>>> = Mutex::new(Cell::new(None));

#[exception]
fn SysTick() {
    static mut TICK: Option<Tick> = None;
    let tick = TICK.get_or_insert_with(|| Tick::start(&BANK));
    let forces_n = tick.run(&BANK);
    free(|section| {
        FORCES_N.borrow(section).set(Some(forces_n));
        let slot = REPORT.borrow(section);
        if tick.count().is_multiple_of(REPORT_EVERY) && slot.get().is_none() {
            slot.set(Some(tick.report()));
        }
    });
}

/// The last forces (N) if they are new. If the main loop is idle, sleeps until an interrupt before it returns `None`.
/// An interrupt that comes before the sleep ends it, because it runs only afterwards.
fn wait_for_forces(is_idle: bool) -> Option<[f32; DAMPERS]> {
    free(|section| {
        let forces_n = FORCES_N.borrow(section).take();
        if forces_n.is_none() && is_idle {
            cortex_m::asm::wfi();
        }
        forces_n
    })
}

fn line(report: &Report) -> Result<String<512>, core::fmt::Error> {
    let mut line = String::new();
    let Report {
        tick,
        hash,
        status,
        rejected,
        late,
        cycles,
        forces_n,
    } = report;
    write!(
        line,
        "tick {tick} hash {hash:08x} status {} rejected {rejected} late {late} cycles {cycles} forces",
        status.bits()
    )?;
    for force_n in forces_n {
        write!(line, " {}", *force_n as i32)?;
    }
    line.write_str("\r\n")?;
    Ok(line)
}

#[entry]
fn main() -> ! {
    board::start();
    board::start_clock();
    let Some(mut core) = cortex_m::Peripherals::take() else {
        safe_state::halt();
    };
    let mut uart = Uart::start(Port::Link, BAUD);
    let mut outputs = SerialOutputs::start();
    let mut text = String::try_from("start\r\n").unwrap_or_default();
    let mut sent = 0;
    board::start_ticks(&mut core.SYST, STEP_S);
    board::start_watchdog();
    loop {
        let is_idle = sent == text.len() && outputs.is_idle();
        if let Some(forces_n) = wait_for_forces(is_idle) {
            outputs.drive(&forces_n);
            board::feed_watchdog();
        }
        outputs.send_waiting();
        match text.as_bytes().get(sent) {
            Some(byte) => sent += usize::from(uart.send(*byte)),
            None => {
                if let Some(report) = free(|section| REPORT.borrow(section).take()) {
                    text = line(&report).unwrap_or_default();
                    sent = 0;
                }
            }
        }
    }
}
