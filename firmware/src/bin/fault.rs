//! Drives the outputs, then causes a fault. The outputs after the fault must be zero.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use dashpot_core::link::Outputs;
use dashpot_firmware::bank::DAMPERS;
use dashpot_firmware::outputs::SerialOutputs;

#[entry]
fn main() -> ! {
    let mut outputs = SerialOutputs::start();
    for tick in 1..=3 {
        outputs.drive(&[1000.0 * tick as f32; DAMPERS]);
        // This call sends only what the line takes now, at least one byte, so the fault interrupts the last packet.
        outputs.send_waiting();
    }
    cortex_m::asm::udf()
}
