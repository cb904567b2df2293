//! Counts the instructions that a tick of the health estimator takes, over samples that the host puts into memory. Also
//! computes a digest of the results.
//!
//! The host loads a [`Watch`] at [`__sheap`] before the start and reads one JSON object from the link's UART. The
//! documentation of the image `step-cost` explains the counts.
#![no_std]
#![no_main]

use core::fmt::Write;
use core::hint::black_box;

use cortex_m_rt::entry;
use dashpot::{DashpotHealth, DashpotHealthModel, dashpot_health_tick};
use dashpot_core::health::{Health, HealthModel};
use dashpot_experiment::watch::{BYTES, Watch};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::counted_call::{counted_ticks, nothing};
use dashpot_firmware::printer::Printer;

unsafe extern "C" {
    /// RAM for the samples from the host, unused by start-up code, data and stack. The linker script of cortex-m-rt
    /// defines the symbol.
    static __sheap: [u8; BYTES];
}

/// A tick whose displacement and force are in memory; two instructions load them.
extern "C" fn tick(health: &mut Health, model: &HealthModel, sample: &[f32; 2]) {
    health.tick(model, sample[0], sample[1]);
}

/// A tick through the C library.
extern "C" fn c_tick(
    health: *mut DashpotHealth,
    model: *const DashpotHealthModel,
    sample: &[f32; 2],
) {
    // SAFETY: the caller's pointers are valid, and their storage has the layout of the C types.
    let _ = unsafe { dashpot_health_tick(model, health, sample[0], sample[1]) };
}

fn timed(function: *const (), integers: [usize; 5]) -> u32 {
    // SAFETY: every caller below passes valid arguments of the function's types.
    unsafe { counted_ticks(function, integers) }
}

#[entry]
fn main() -> ! {
    board::start_clock();
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    // SAFETY: the host wrote this memory before the start; nothing writes it now.
    let bytes = unsafe { &*black_box(&raw const __sheap) };
    match Watch::parse(bytes) {
        Some(watch) => measure(&watch, &mut printer),
        None => drop(writeln!(printer, "no samples were loaded")),
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn measure(watch: &Watch<'_>, printer: &mut Printer) {
    let Ok(model) = HealthModel::from_image(watch.model) else {
        let _ = writeln!(
            printer,
            "the samples contain no valid health model for this core"
        );
        return;
    };
    let call = timed(nothing as *const (), [0; 5]);
    let (mut min, mut max, mut sum) = (u32::MAX, 0, 0_u64);
    let digest = watch.run(&model, |health, model, sample| {
        let integers = [
            (&raw mut *health).expose_provenance(),
            (&raw const *model).expose_provenance(),
            (&raw const *sample).expose_provenance(),
            0,
            0,
        ];
        let ticks = timed(tick as *const (), integers);
        min = ticks.min(min);
        max = ticks.max(max);
        sum += u64::from(ticks);
    });
    let mut c_max = 0;
    let c_digest = watch.run(&model, |health, model, sample| {
        let integers = [
            (&raw mut *health).expose_provenance(),
            (&raw const *model).expose_provenance(),
            (&raw const *sample).expose_provenance(),
            0,
            0,
        ];
        c_max = timed(c_tick as *const (), integers).max(c_max);
    });
    if c_digest.value() != digest.value() {
        let _ = writeln!(printer, "the C library gives other results than the core");
        return;
    }
    let _ = writeln!(
        printer,
        "{{\"clock_hz\": {CLOCK_HZ}, \"call\": {call}, \"least\": {min}, \"most\": {max}, \"sum\": {sum}, \"c_most\": \
         {c_max}, \
         \"digest\": \"{:016x}\", \"model_bytes\": {}, \"health_bytes\": {}}}",
        digest.value(),
        size_of::<HealthModel>(),
        size_of::<Health>(),
    );
}
