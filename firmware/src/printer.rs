//! Text output on a UART for the measuring images.

use core::fmt::{Result, Write};

use dashpot_core::link::Line;

use crate::board::Uart;

/// Writes to a UART and waits for room.
#[derive(Debug)]
pub struct Printer(pub Uart);

impl Write for Printer {
    fn write_str(&mut self, text: &str) -> Result {
        for byte in text.bytes() {
            while !self.0.send(byte) {}
        }
        Ok(())
    }
}
