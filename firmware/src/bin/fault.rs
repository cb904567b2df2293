//! Drives the outputs, then makes a fault: what comes out afterwards must be zero.
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
        // The last packet is broken off: a pass sends what the line takes, at least a byte.
        outputs.send_waiting();
    }
    cortex_m::asm::udf()
}
