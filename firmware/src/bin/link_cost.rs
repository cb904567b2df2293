//! Measures one tick of the bank with everything the link takes: a step request received byte by byte
//! from the UART's register, carried out, answered byte by byte.
//!
//! Answers go to the spare UART. Prints one JSON object on that of the link: clock ticks of [`CLOCK_HZ`] for all requests together, the most
//! for one, bytes in and out. Under QEMU's `-icount shift=0` a clock tick is 40 instructions.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use dashpot_core::link::{Device, Frame, Header, PROTOCOL, Reals, Request};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::outputs;
use dashpot_firmware::printer::Printer;

const REQUESTS: usize = 1000;
/// Of the triangular motion (m), its half period (ticks).
const AMPLITUDE_M: f32 = 5e-3;
const HALF_PERIOD: u32 = 125;

#[entry]
fn main() -> ! {
    let mut device = Device::<DAMPERS>::new(&BANK, board::start_clock());
    let mut uart = Uart::start(Port::Spare, 1_000_000);
    let mut frame = Frame::new();
    let header = |sequence| Header {
        session: 0x1234,
        sequence,
    };
    let hello = Request::Hello { protocol: PROTOCOL };
    frame.write(&(header(0), hello));
    let _ = frame
        .bytes()
        .iter()
        .filter(|byte| device.receive(**byte))
        .count();

    let (mut total, mut most, mut bytes_in, mut bytes_out) = (0, 0, 0, 0);
    for tick in 1..=REQUESTS as u32 {
        let displacements_m: Reals = (0..DAMPERS as u32)
            .map(|i| triangle(tick + 9 * i))
            .collect();
        let step = Request::Step {
            tick,
            displacements_m,
        };
        frame.write(&(header(tick), step));
        let start = board::clock_now();
        for byte in frame.bytes() {
            // The register is read as when a byte waits in it.
            if uart.receive().is_none() && device.receive(*byte) {
                outputs::drive(device.outputs_n());
                for byte in device.response() {
                    while !uart.send(*byte) {}
                }
            }
        }
        let taken = board::clock_now().wrapping_sub(start);
        total += taken;
        most = most.max(taken);
        bytes_in += frame.bytes().len();
        bytes_out += device.response().len();
    }
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let _ = writeln!(
        printer,
        "{{\"requests\": {REQUESTS}, \"accepted\": {}, \"clock_hz\": {CLOCK_HZ}, \"clock_ticks\": {total}, \
         \"most_clock_ticks\": {most}, \"bytes_in\": {bytes_in}, \"bytes_out\": {bytes_out}}}",
        device.counters().accepted
    );
    loop {
        cortex_m::asm::wfi();
    }
}

/// Triangular motion (m).
fn triangle(tick: u32) -> f32 {
    let phase = tick % (2 * HALF_PERIOD);
    let distance = phase.min(2 * HALF_PERIOD - phase) as f32;
    AMPLITUDE_M * (2.0 * distance / HALF_PERIOD as f32 - 1.0)
}
