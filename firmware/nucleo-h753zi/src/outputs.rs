//! Sends the forces to the actuators as packets on USART6, in place of a field bus to the drives (docs/link.md has the
//! packet). Change this file for another bus.

use dashpot_core::link::Outputs;
use dashpot_device::ForcePacket;
use embassy_stm32::mode::Async;
use embassy_stm32::pac::{USART6, usart::regs::Dr};
use embassy_stm32::usart::UartTx;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;

use crate::bank::DAMPERS;

/// The last forces (N) that are not sent yet.
static FORCES_N: Signal<CriticalSectionRawMutex, [f32; DAMPERS]> = Signal::new();

/// Hands forces to [`send`]. Forces that are set while a packet is being sent wait until it ends; only the last ones
/// are sent.
#[derive(Debug)]
pub struct SerialOutputs;

impl Outputs<DAMPERS> for SerialOutputs {
    fn drive(&mut self, forces_n: &[f32; DAMPERS]) {
        FORCES_N.signal(*forces_n);
    }
}

/// Sends each new set of forces.
#[embassy_executor::task]
pub async fn send(mut uart: UartTx<'static, Async>) {
    loop {
        let packet = ForcePacket::new(&FORCES_N.wait().await);
        if let Err(error) = uart.write(packet.bytes()).await {
            log::warn!("outputs: {error:?}");
        }
    }
}

/// Sets every output to zero after a panic or fault: zero bytes complete an interrupted packet, then a packet with zero
/// forces follows. Waits for the line for a limited time.
pub fn zero() {
    USART6.cr3().modify(|control| control.set_dmat(false));
    let packet = ForcePacket::new(&[0.0; DAMPERS]);
    let end = packet.bytes().iter().map(|_| &0);
    for byte in end.chain(packet.bytes()) {
        // A byte takes 2560 clocks.
        if (0..10_000).any(|_| USART6.isr().read().txe()) {
            USART6.tdr().write_value(Dr(u32::from(*byte)));
        }
    }
}
