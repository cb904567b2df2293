//! Counts the instructions that a tick of a hybrid test takes: adaptive compensator, tracking, energy and guard. Also
//! computes a digest of the results.
//!
//! The host reads one JSON object from the link's UART. The documentation of the image `step-cost` explains the counts.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use dashpot_core::hybrid::{Command, HybridStatus, Measured, Motion};
use dashpot_experiment::transfer::{self, System};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::counted_call::{counted_ticks, nothing};
use dashpot_firmware::printer::Printer;

/// A tick whose arguments and result are in memory.
extern "C" fn tick(
    system: &mut System,
    desired: &Motion,
    measured: &Option<Measured>,
    command: &mut Command,
) {
    *command = system.tick(desired, *measured);
}

fn timed(function: *const (), integers: [usize; 5]) -> u32 {
    // SAFETY: every caller below passes valid arguments of the function's types.
    unsafe { counted_ticks(function, integers) }
}

#[entry]
fn main() -> ! {
    board::start_clock();
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    match transfer::system() {
        Ok(mut system) => measure(&mut system, &mut printer),
        Err(_) => drop(writeln!(printer, "the settings are not allowed")),
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn measure(system: &mut System, printer: &mut Printer) {
    let call = timed(nothing as *const (), [0; 5]);
    let (mut min, mut max, mut running) = (u32::MAX, 0, (u32::MAX, 0));
    let (digest, noticed) = transfer::run(system, |system, desired, measured| {
        let mut command = Command {
            command_m: 0.0,
            force_n: 0.0,
            status: HybridStatus::empty(),
        };
        let integers = [
            (&raw mut *system).expose_provenance(),
            (&raw const *desired).expose_provenance(),
            (&raw const *measured).expose_provenance(),
            (&raw mut command).expose_provenance(),
            0,
        ];
        let ticks = timed(tick as *const (), integers);
        min = ticks.min(min);
        max = ticks.max(max);
        if system.guard().is_running() && measured.is_some() {
            running = (ticks.min(running.0), ticks.max(running.1));
        }
        command
    });
    let _ = writeln!(
        printer,
        "{{\"clock_hz\": {CLOCK_HZ}, \"call\": {call}, \"least\": {min}, \"most\": {max}, \"running_least\": {}, \
         \"running_most\": {}, \
         \"digest\": \"{:016x}\", \"noticed\": {}, \"system_bytes\": {}}}",
        running.0,
        running.1,
        digest.value(),
        noticed.bits(),
        size_of::<System>(),
    );
}
