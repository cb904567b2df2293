//! Sends the forces to the actuators as packets on the board's second UART, in place of a field bus to the drives.
//! Change this file for another bus.
//!
//! A packet is `ff ff ff ff`, then each force (N) in single precision, little-endian. No force has this bit pattern, so
//! a reader can synchronise to it.

use dashpot_core::link::{Line, Outputs};

use crate::bank::DAMPERS;
use crate::board::{Port, Uart};

/// Bits per second. A packet takes a third of a 1 ms tick.
const BAUD: u32 = 1_562_500;

/// Number of bytes of a packet.
const BYTES: usize = 4 + 4 * DAMPERS;

fn packet(forces_n: &[f32; DAMPERS]) -> [u8; BYTES] {
    let mut packet = [0xff; BYTES];
    let (words, _) = packet.as_chunks_mut::<4>();
    for (word, force_n) in words.iter_mut().skip(1).zip(forces_n) {
        *word = force_n.to_le_bytes();
    }
    packet
}

/// The second UART, which sends the last forces as fast as the line allows. Forces that are set while a packet is being
/// sent wait until it ends; only the last ones are sent.
#[derive(Debug)]
pub struct SerialOutputs {
    uart: Uart,
    packet: [u8; BYTES],
    /// Number of bytes at the end of the packet that are not sent yet.
    unsent: usize,
    waiting: Option<[f32; DAMPERS]>,
}

impl SerialOutputs {
    /// Starts the UART without sending.
    pub fn start() -> Self {
        Self {
            uart: Uart::start(Port::Outputs, BAUD),
            packet: [0; BYTES],
            unsent: 0,
            waiting: None,
        }
    }

    /// True if there is nothing to send.
    pub fn is_idle(&self) -> bool {
        self.unsent == 0 && self.waiting.is_none()
    }

    /// Sends as many bytes as the line takes now.
    pub fn send_waiting(&mut self) {
        if self.unsent == 0 {
            let Some(forces_n) = self.waiting.take() else {
                return;
            };
            self.packet = packet(&forces_n);
            self.unsent = BYTES;
        }
        let unsent = self.packet.get(BYTES.wrapping_sub(self.unsent)..);
        let mut unsent = unsent.unwrap_or_default().iter();
        while unsent
            .as_slice()
            .first()
            .is_some_and(|byte| self.uart.send(*byte))
        {
            unsent.next();
        }
        self.unsent = unsent.len();
    }
}

impl Outputs<DAMPERS> for SerialOutputs {
    fn drive(&mut self, forces_n: &[f32; DAMPERS]) {
        self.waiting = Some(*forces_n);
    }
}

/// Sets every output to zero after a panic or fault: zero bytes complete an interrupted packet, then a packet with zero
/// forces follows. Waits for the line for a limited time.
pub fn zero() {
    let mut uart = Uart::start(Port::Outputs, BAUD);
    let end = [0; BYTES];
    for byte in end.iter().chain(&packet(&[0.0; DAMPERS])) {
        // A byte takes 10 bits of 16 clocks; each attempt takes a few clocks.
        let _ = (0..1000).any(|_| uart.send(*byte));
    }
}
