//! The Ethernet controller that QEMU gives the MPS2 with AN500: SMSC LAN9118 (data sheet, chapters 3 and 5). It is
//! asked again and again, without interrupts.

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};
use core::task::Context;

use embassy_net_driver::{Capabilities, Driver, HardwareAddress, LinkState, RxToken, TxToken};

const BASE: usize = 0xa000_0000;
const RX_DATA: usize = BASE;
const TX_DATA: usize = BASE + 0x20;
/// Bits 16 to 29: length of a frame with its checksum (bytes).
const RX_STATUS: usize = BASE + 0x40;
const TX_STATUS: usize = BASE + 0x48;
/// Bit 1: transmitter on.
const TX_CONFIGURATION: usize = BASE + 0x70;
/// Bits 16 to 23: number of frames that wait.
const RX_WAITING: usize = BASE + 0x7c;
/// Bits 0 to 15: free bytes. Bits 16 to 23: number of frames that were sent.
const TX_FREE: usize = BASE + 0x80;
/// Bit 31: access. Bit 30: read. Bits 0 to 7: register of the MAC.
const MAC_COMMAND: usize = BASE + 0xa4;
const MAC_DATA: usize = BASE + 0xa8;

const MAC_CONTROL: u32 = 1;
const MAC_ADDRESS_HIGH: u32 = 2;
const MAC_ADDRESS_LOW: u32 = 3;
const MAC_TRANSMIT_AND_RECEIVE: u32 = 0b1100;

const FIRST_AND_LAST_PART: u32 = 0x3000;
/// Largest frame without its checksum (bytes).
const FRAME_BYTES: usize = 1514;
/// With its checksum, in whole words.
const BUFFER_BYTES: usize = 1520;

fn read(register: usize) -> u32 {
    // SAFETY: every address in this file is a register of the controller, word-aligned and readable.
    unsafe { with_exposed_provenance::<u32>(register).read_volatile() }
}

fn write(register: usize, value: u32) {
    // SAFETY: as in `read`; no register affects memory.
    unsafe { with_exposed_provenance_mut::<u32>(register).write_volatile(value) }
}

fn read_mac(register: u32) -> u32 {
    write(MAC_COMMAND, 0xc000_0000 | register);
    read(MAC_DATA)
}

/// The controller.
#[derive(Debug)]
pub struct Lan9118 {
    received: [u8; BUFFER_BYTES],
    sent: [u8; BUFFER_BYTES],
}

/// A frame that waits in the controller.
#[derive(Debug)]
pub struct Received<'a>(&'a mut [u8; BUFFER_BYTES]);

/// Room for a frame.
#[derive(Debug)]
pub struct Room<'a>(&'a mut [u8; BUFFER_BYTES]);

impl Lan9118 {
    /// Buffers of a controller that does not run yet.
    pub const fn new() -> Self {
        Self {
            received: [0; BUFFER_BYTES],
            sent: [0; BUFFER_BYTES],
        }
    }

    /// Starts to send and receive.
    pub fn start(&mut self) {
        write(TX_CONFIGURATION, 0b10);
        write(MAC_DATA, MAC_TRANSMIT_AND_RECEIVE);
        write(MAC_COMMAND, 0x8000_0000 | MAC_CONTROL);
    }
}

impl Default for Lan9118 {
    fn default() -> Self {
        Self::new()
    }
}

impl RxToken for Received<'_> {
    fn consume<R, F: FnOnce(&mut [u8]) -> R>(self, process: F) -> R {
        let bytes = (read(RX_STATUS) >> 16 & 0x3fff) as usize;
        let (words, _) = self.0.as_chunks_mut::<4>();
        let mut slots = words.iter_mut();
        for _ in 0..bytes.div_ceil(4) {
            let word = read(RX_DATA).to_le_bytes();
            if let Some(slot) = slots.next() {
                *slot = word;
            }
        }
        let frame = self.0.get_mut(..bytes.saturating_sub(4));
        process(frame.unwrap_or_default())
    }
}

impl TxToken for Room<'_> {
    fn consume<R, F: FnOnce(&mut [u8]) -> R>(self, bytes: usize, fill: F) -> R {
        let bytes = bytes.min(FRAME_BYTES);
        let result = fill(self.0.get_mut(..bytes).unwrap_or_default());
        write(TX_DATA, FIRST_AND_LAST_PART | bytes as u32);
        write(TX_DATA, bytes as u32);
        let (words, _) = self.0.as_chunks::<4>();
        for word in words.iter().take(bytes.div_ceil(4)) {
            write(TX_DATA, u32::from_le_bytes(*word));
        }
        result
    }
}

impl Driver for Lan9118 {
    type RxToken<'a> = Received<'a>;
    type TxToken<'a> = Room<'a>;

    fn receive(&mut self, context: &mut Context<'_>) -> Option<(Received<'_>, Room<'_>)> {
        context.waker().wake_by_ref();
        let waits = read(RX_WAITING) >> 16 & 0xff != 0;
        waits.then_some((Received(&mut self.received), Room(&mut self.sent)))
    }

    fn transmit(&mut self, context: &mut Context<'_>) -> Option<Room<'_>> {
        context.waker().wake_by_ref();
        while read(TX_FREE) >> 16 & 0xff != 0 {
            read(TX_STATUS);
        }
        let free = (read(TX_FREE) & 0xffff) as usize;
        (free > BUFFER_BYTES + 8).then_some(Room(&mut self.sent))
    }

    fn link_state(&mut self, _: &mut Context<'_>) -> LinkState {
        LinkState::Up
    }

    fn capabilities(&self) -> Capabilities {
        let mut capabilities = Capabilities::default();
        capabilities.max_transmission_unit = FRAME_BYTES;
        capabilities
    }

    fn hardware_address(&self) -> HardwareAddress {
        let [a, b, c, d] = read_mac(MAC_ADDRESS_LOW).to_le_bytes();
        let [e, f, ..] = read_mac(MAC_ADDRESS_HIGH).to_le_bytes();
        HardwareAddress::Ethernet([a, b, c, d, e, f])
    }
}
