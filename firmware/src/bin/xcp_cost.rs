//! Counts the instructions that a slave of XCP takes in a tick and for a command, with a bank's forces as its memory.
//! Prints one JSON object on the link's UART. The documentation of the image `step-cost` explains the counts.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use dashpot_core::xcp::{Address, ErrorCode, Event, Memory, Slave};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::counted_call::{counted_ticks, nothing};
use dashpot_firmware::printer::Printer;
use static_cell::ConstStaticCell;

/// Displacement, force and status of twelve dampers, 4 bytes each.
const BYTES: usize = 12 * 3 * 4;
/// Largest packet of samples: one byte of length is enough on a serial line.
const MAX_DTO: usize = 128;

type SmallSlave = Slave<2, 4, 36, MAX_DTO>;

static SLAVE: ConstStaticCell<SmallSlave> = ConstStaticCell::new(SmallSlave::new());

/// What the slave measures.
struct Board {
    values: [u8; BYTES],
}

/// What it sends.
struct Sent {
    bytes: [u8; MAX_DTO],
    length: usize,
}

impl Sent {
    fn put(&mut self, packet: &[u8]) {
        if let Some(to) = self.bytes.get_mut(..packet.len()) {
            to.copy_from_slice(packet);
            self.length = packet.len();
        }
    }
}

impl Memory for Board {
    fn read(&self, address: Address, into: &mut [u8]) -> Result<(), ErrorCode> {
        let start = address.offset as usize;
        let end = start.wrapping_add(into.len());
        match self.values.get(start..end) {
            Some(bytes) if address.extension == 0 => into.copy_from_slice(bytes),
            _ => return Err(ErrorCode::AccessDenied),
        }
        Ok(())
    }

    fn event(&self, channel: u16) -> Option<Event> {
        (channel == 0).then_some(Event { cycle: 1, unit: 6 })
    }
}

/// A tick: the packets of the running lists go into a buffer for the UART.
extern "C" fn sample(slave: &mut SmallSlave, board: &mut Board, sent: &mut Sent) {
    slave.sample(0, board, |packet| sent.put(packet));
}

/// A command of 8 bytes, whose response goes into the buffer.
extern "C" fn receive(
    slave: &mut SmallSlave,
    board: &mut Board,
    sent: &mut Sent,
    packet: &[u8; 8],
) {
    if let Some(response) = slave.receive(packet, board) {
        sent.put(&response);
    }
}

/// A slave with what it measures and sends.
struct Bench<'a> {
    slave: &'a mut SmallSlave,
    board: Board,
    sent: Sent,
}

impl Bench<'_> {
    fn timed(&mut self, function: *const (), packet: &[u8; 8]) -> u32 {
        let integers = [
            (&raw mut *self.slave).expose_provenance(),
            (&raw mut self.board).expose_provenance(),
            (&raw mut self.sent).expose_provenance(),
            (&raw const *packet).expose_provenance(),
            0,
        ];
        // SAFETY: both functions take these arguments, and `sample` leaves the last one out.
        unsafe { counted_ticks(function, integers) }
    }

    /// The cost of a tick with one list of `entries` entries of `size` bytes, and the bytes that it sends.
    fn tick(&mut self, entries: u8, size: u8, is_started: bool) -> (u32, usize) {
        start(self.slave, &mut self.board, entries, size, is_started);
        self.sent.length = 0;
        let ticks = self.timed(sample as *const (), &[0; 8]);
        (ticks, self.sent.length)
    }
}

/// Sets up one list with `entries` entries of `size` bytes, and starts it if wanted.
fn start(slave: &mut SmallSlave, board: &mut Board, entries: u8, size: u8, is_started: bool) {
    let mut send = |packet: &[u8]| drop(slave.receive(packet, board));
    send(&[0xFF, 0]);
    send(&[0xD6]);
    send(&[0xD5, 0, 1, 0]);
    send(&[0xD4, 0, 0, 0, 1]);
    send(&[0xD3, 0, 0, 0, 0, entries]);
    send(&[0xE2, 0, 0, 0, 0, 0]);
    for entry in 0..entries {
        send(&[0xE1, 0xFF, size, 0, entry * size, 0, 0, 0]);
    }
    send(&[0xE0, 0x10, 0, 0, 0, 0, 1, 0]);
    if is_started {
        send(&[0xDE, 1, 0, 0]);
    }
}

#[entry]
fn main() -> ! {
    board::start_clock();
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    if let Some(slave) = SLAVE.try_take() {
        measure(slave, &mut printer);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn measure(slave: &mut SmallSlave, printer: &mut Printer) {
    let board = Board { values: [0; BYTES] };
    let sent = Sent {
        bytes: [0; MAX_DTO],
        length: 0,
    };
    let mut bench = Bench { slave, board, sent };
    // SAFETY: the function has no arguments.
    let call = unsafe { counted_ticks(nothing as *const (), [0; 5]) };
    let (stopped, _) = bench.tick(12, 4, false);
    let (one, one_bytes) = bench.tick(1, 4, true);
    let (block, block_bytes) = bench.tick(1, 48, true);
    let (twelve, twelve_bytes) = bench.tick(12, 4, true);
    let mut command = |packet| bench.timed(receive as *const (), packet);
    let status = command(&[0xFD, 0, 0, 0, 0, 0, 0, 0]);
    let upload = command(&[0xF4, 144, 0, 0, 0, 0, 0, 0]);
    let _ = writeln!(
        printer,
        "{{\"clock_hz\": {CLOCK_HZ}, \"call\": {call}, \"slave_bytes\": {}, \"stopped\": {stopped}, \"one\": {one}, \
         \"one_bytes\": {one_bytes}, \"block\": {block}, \"block_bytes\": {block_bytes}, \"twelve\": {twelve}, \
         \"twelve_bytes\": {twelve_bytes}, \"status\": {status}, \"upload\": {upload}}}",
        size_of::<SmallSlave>()
    );
}
