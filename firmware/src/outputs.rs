//! The forces on their way to the actuators: packets on the board's second UART, as a rig's drives take them from
//! a bus. For another bus this file changes.
//!
//! A packet is `ff ff ff ff`, then each force (N) in single precision, little-endian. No force has that bit
//! pattern, so a reader that comes late waits for it.

use dashpot_core::link::{Line, Outputs};

use crate::bank::DAMPERS;
use crate::board::{Port, Uart};

/// Bits a second: a packet takes a third of a tick of 1 ms.
const BAUD: u32 = 1_562_500;

/// Bytes of a packet.
const BYTES: usize = 4 + 4 * DAMPERS;

fn packet(forces_n: &[f32; DAMPERS]) -> [u8; BYTES] {
    let mut packet = [0xff; BYTES];
    let (words, _) = packet.as_chunks_mut::<4>();
    for (word, force_n) in words.iter_mut().skip(1).zip(forces_n) {
        *word = force_n.to_le_bytes();
    }
    packet
}

/// The second UART: sends the forces set last, as fast as the line takes them; those set while a packet is under
/// way wait for its end, and of several the last are sent.
#[derive(Debug)]
pub struct SerialOutputs {
    uart: Uart,
    packet: [u8; BYTES],
    /// Bytes of the packet still to send, from the end.
    unsent: usize,
    waiting: Option<[f32; DAMPERS]>,
}

impl SerialOutputs {
    /// Starts the UART; nothing is sent yet.
    pub fn start() -> Self {
        Self {
            uart: Uart::start(Port::Outputs, BAUD),
            packet: [0; BYTES],
            unsent: 0,
            waiting: None,
        }
    }

    /// Sends what the line takes.
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

/// Sets every output to zero after a panic or fault, whatever was under way: zeros end a broken packet, then one
/// of zeros follows. Waits for the line, a while at most.
pub fn zero() {
    let mut uart = Uart::start(Port::Outputs, BAUD);
    let end = [0; BYTES];
    for byte in end.iter().chain(&packet(&[0.0; DAMPERS])) {
        // A byte takes 10 bits of 16 clocks; a try takes a few.
        let _ = (0..1000).any(|_| uart.send(*byte));
    }
}
