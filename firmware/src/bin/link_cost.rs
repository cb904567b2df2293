//! Measures one tick of the bank with everything the link takes: a step request received byte by byte
//! from a UART's register, carried out, answered byte by byte, and the outputs sent.
//!
//! Answers go to the spare UART. Prints one JSON object on that of the link: clock ticks of [`CLOCK_HZ`] for all
//! requests together, the most for one, bytes in and out; also what devices of 1, 4, 12 and 16 dampers take. Under QEMU's `-icount shift=0` a clock tick is 40
//! instructions.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use dashpot_core::link::{Device, Frame, Header, Line, PROTOCOL, Reals, Request};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::printer::Printer;
use dashpot_firmware::safe_state;
use static_cell::ConstStaticCell;

const REQUESTS: usize = 1000;
/// Of the triangular motion (m), its half period (ticks).
const AMPLITUDE_M: f32 = 5e-3;
const HALF_PERIOD: u32 = 125;

static DEVICE: ConstStaticCell<Device<DAMPERS, DAMPERS>> = ConstStaticCell::new(Device::new());

/// A line on which a frame waits, as if the UART had received it: its registers are read as when it had.
struct Replayed<'a> {
    uart: Uart,
    frame: &'a [u8],
}

impl Line for Replayed<'_> {
    #[inline]
    fn receive(&mut self) -> Option<u8> {
        if self.uart.receive().is_some() {
            return None;
        }
        let (byte, rest) = self.frame.split_first()?;
        self.frame = rest;
        Some(*byte)
    }

    #[inline]
    fn send(&mut self, byte: u8) -> bool {
        self.uart.send(byte)
    }
}

#[entry]
fn main() -> ! {
    let Some(device) = DEVICE.try_take() else {
        safe_state::halt();
    };
    // Behind a pointer fields are reached by their offsets; of a known address each takes two more instructions.
    let device = core::hint::black_box(device);
    if device.start(&BANK, board::start_clock()).is_err() {
        safe_state::halt();
    }
    let mut outputs = SerialOutputs::start();
    let mut frame = Frame::<128>::new();
    let header = |sequence| Header {
        session: 0x1234,
        sequence,
    };
    let mut ask = |frame: &Frame<128>| {
        let mut line = Replayed {
            uart: Uart::start(Port::Spare, 1_562_500),
            frame: frame.bytes(),
        };
        let start = board::clock_now();
        while !line.frame.is_empty() || device.is_sending() {
            device.poll(0, &mut line, &mut outputs);
            outputs.send_waiting();
        }
        let taken = board::clock_now().wrapping_sub(start);
        (taken, device.response().len())
    };
    frame.write(&(header(0), Request::Hello { protocol: PROTOCOL }));
    ask(&frame);

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
        let (taken, sent) = ask(&frame);
        total += taken;
        most = most.max(taken);
        bytes_in += frame.bytes().len();
        bytes_out += sent;
    }
    let accepted = device.counters().accepted;
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let _ = writeln!(
        printer,
        "{{\"requests\": {REQUESTS}, \"accepted\": {accepted}, \"clock_hz\": {CLOCK_HZ}, \"clock_ticks\": {total}, \
         \"most_clock_ticks\": {most}, \"bytes_in\": {bytes_in}, \"bytes_out\": {bytes_out}, \
         \"device_bytes\": [{}, {}, {}, {}]}}",
        size_of::<Device<1>>(),
        size_of::<Device<4>>(),
        size_of::<Device<12>>(),
        size_of::<Device<16>>()
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
