//! Measures one tick of the bank including the link: a step request is received byte by byte from the register of a
//! UART, carried out and answered byte by byte, and the outputs are sent.
//!
//! Answers go to the spare UART. The image prints one JSON object on the UART of the link: clock ticks at [`CLOCK_HZ`]
//! for all requests, the largest number of clock ticks of one request, and bytes in and out. For health it prints the
//! largest number of clock ticks for each of these: a slice while a model is loaded, a request with measured samples, a
//! reading. The host puts the model at [`__sheap`]. The image also prints the sizes of devices with 1, 4, 12 and 16
//! dampers. Under QEMU's `-icount shift=0` a clock tick is 40 instructions.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use dashpot_core::health::HealthModel;
use dashpot_core::link::{
    Device, Frame, Header, Line, MAX_MEASURED, MEASURED_BYTES, PROTOCOL, Reals, Request,
};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::printer::Printer;
use dashpot_firmware::safe_state;
use static_cell::ConstStaticCell;

const REQUESTS: usize = 1000;
/// Number of requests with measured samples. Each request has [`MAX_MEASURED`] samples.
const MEASUREMENTS: u32 = 500;
/// Ratio of force to displacement of the measured samples (N/m), large enough for contact most of the time.
const STIFFNESS_N_PER_M: f32 = 4e5;
/// Amplitude of the triangular motion (m).
const AMPLITUDE_M: f32 = 5e-3;
/// Half period of the triangular motion (ticks).
const HALF_PERIOD: u32 = 125;

/// A frame with a whole health model.
type LongFrame = Frame<{ HealthModel::IMAGE_BYTES + 64 }>;

unsafe extern "C" {
    /// RAM for the model from the host, unused by start-up code, data and stack. The linker script of cortex-m-rt
    /// defines the symbol.
    static __sheap: [u8; HealthModel::IMAGE_BYTES];
}

static DEVICE: ConstStaticCell<Device<DAMPERS, DAMPERS>> = ConstStaticCell::new(Device::new());

/// A serial line on which a frame waits to be read. It reads the registers of the UART as if the UART had received the
/// frame.
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
    // Hides the address from the compiler. If the compiler knows the address, each access takes two instructions more
    // than with an offset from a pointer.
    let device = core::hint::black_box(device);
    if device.start(&BANK, board::start_clock()).is_err() {
        safe_state::halt();
    }
    let mut outputs = SerialOutputs::start();
    let mut frame = Frame::<128>::new();
    frame.write(&(header(0), Request::Hello { protocol: PROTOCOL }));
    ask(device, &mut outputs, frame.bytes());

    let (mut total, mut most, mut limited, mut bytes_in, mut bytes_out) = (0, 0, 0, 0, 0);
    for tick in 1..=REQUESTS as u32 {
        let displacements_m: Reals = (0..DAMPERS as u32)
            .map(|i| triangle(tick + 9 * i))
            .collect();
        let step = Request::Step {
            tick,
            displacements_m,
        };
        frame.write(&(header(tick), step));
        let asked = ask(device, &mut outputs, frame.bytes());
        total += asked.ticks;
        // The first displacements are too far from rest, so the displacements of all dampers are limited.
        if tick == 1 {
            limited = asked.ticks;
        } else {
            most = most.max(asked.ticks);
        }
        bytes_in += frame.bytes().len();
        bytes_out += asked.sent;
    }
    let accepted = device.counters().accepted;
    let health = measure_health(device, &mut outputs, REQUESTS as u32);
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let _ = writeln!(
        printer,
        "{{\"requests\": {REQUESTS}, \"accepted\": {accepted}, \"clock_hz\": {CLOCK_HZ}, \"clock_ticks\": {total}, \
         \"most_clock_ticks\": {most}, \"limited_clock_ticks\": {limited}, \"bytes_in\": {bytes_in}, \"bytes_out\": \
         {bytes_out}, \
         \"health_accepted\": {}, \"health_slice\": {}, \"health_measure\": {}, \"health_reading\": {}, \
         \"device_bytes\": [{}, {}, {}, {}], \"watching_device_bytes\": [{}, {}, {}, {}]}}",
        health.accepted,
        health.slice,
        health.measure,
        health.reading,
        size_of::<Device<1>>(),
        size_of::<Device<4>>(),
        size_of::<Device<12>>(),
        size_of::<Device<16>>(),
        size_of::<Device<1, 1>>(),
        size_of::<Device<4, 4>>(),
        size_of::<Device<12, 12>>(),
        size_of::<Device<16, 16>>()
    );
    loop {
        cortex_m::asm::wfi();
    }
}

fn header(sequence: u32) -> Header {
    Header {
        session: 0x1234,
        sequence,
    }
}

/// Cost of a request.
struct Asked {
    /// Clock ticks including the answer and the outputs.
    ticks: u32,
    /// Clock ticks of the longest pass while an image is loaded.
    slice: u32,
    /// Number of bytes of the answer.
    sent: usize,
}

#[inline(never)] // one copy of the device's loop, as in the main image
fn ask(device: &mut Device<DAMPERS, DAMPERS>, outputs: &mut SerialOutputs, frame: &[u8]) -> Asked {
    let mut line = Replayed {
        uart: Uart::start(Port::Spare, 1_562_500),
        frame,
    };
    let start = board::clock_now();
    let mut slice = 0;
    while !line.frame.is_empty() || device.is_sending() || device.is_busy() {
        let loading = device.is_busy().then(board::clock_now);
        device.poll(0, &mut line, outputs);
        if let Some(loading) = loading {
            slice = slice.max(board::clock_now().wrapping_sub(loading));
        }
        outputs.send_waiting();
    }
    let ticks = board::clock_now().wrapping_sub(start);
    let sent = device.response().len();
    Asked { ticks, slice, sent }
}

/// Largest numbers of clock ticks of health requests.
#[derive(Default)]
struct HealthCost {
    /// Number of requests carried out.
    accepted: u32,
    /// Clock ticks of one slice while a model is loaded.
    slice: u32,
    /// Clock ticks of a request with measured samples.
    measure: u32,
    /// Clock ticks of a reading.
    reading: u32,
}

fn measure_health(
    device: &mut Device<DAMPERS, DAMPERS>,
    outputs: &mut SerialOutputs,
    mut sequence: u32,
) -> HealthCost {
    let before = device.counters().accepted;
    let mut cost = HealthCost::default();
    let mut frame = LongFrame::new();
    sequence += 1;
    let load = Request::LoadHealth {
        damper: 0,
        // SAFETY: the host wrote this memory before the start; nothing writes it now.
        image: unsafe { &*core::hint::black_box(&raw const __sheap) },
    };
    frame.write(&(header(sequence), load));
    cost.slice = ask(device, outputs, frame.bytes()).slice;
    for number in 0..MEASUREMENTS {
        let mut samples = [0; MEASURED_BYTES * MAX_MEASURED];
        let (rows, _) = samples.as_chunks_mut::<4>();
        for (index, row) in rows.iter_mut().enumerate() {
            let tick = number * MAX_MEASURED as u32 + index as u32 / 2;
            let displacement_m = triangle(tick);
            let is_force = index % 2 == 1;
            let force_n = STIFFNESS_N_PER_M * displacement_m;
            *row = if is_force { force_n } else { displacement_m }.to_le_bytes();
        }
        sequence += 1;
        let measure = Request::Measure {
            damper: 0,
            samples: &samples,
        };
        frame.write(&(header(sequence), measure));
        cost.measure = cost.measure.max(ask(device, outputs, frame.bytes()).ticks);
        sequence += 1;
        frame.write(&(header(sequence), Request::Health { damper: 0 }));
        cost.reading = cost.reading.max(ask(device, outputs, frame.bytes()).ticks);
    }
    cost.accepted = device.counters().accepted - before;
    cost
}

/// Triangular motion (m).
fn triangle(tick: u32) -> f32 {
    let phase = tick % (2 * HALF_PERIOD);
    let distance = phase.min(2 * HALF_PERIOD - phase) as f32;
    AMPLITUDE_M * (2.0 * distance / HALF_PERIOD as f32 - 1.0)
}
