//! A network card that hands over few frames at a time, so that a flood of frames does not hold up the ticks.

use core::task::Context;

use embassy_net::driver::{Capabilities, Driver, HardwareAddress, LinkState};

/// Frames that the stack takes before other tasks run.
const FRAMES: u8 = 4;

/// A card whose frames the stack takes four at a time. The stack would otherwise go on until none is left, and at
/// 100 Mbit/s that may be never.
#[derive(Debug)]
pub struct FewFrames<D> {
    card: D,
    left: u8,
}

impl<D: Driver> FewFrames<D> {
    /// Limits a card.
    pub const fn new(card: D) -> Self {
        Self { card, left: FRAMES }
    }
}

impl<D: Driver> Driver for FewFrames<D> {
    type RxToken<'a>
        = D::RxToken<'a>
    where
        Self: 'a;
    type TxToken<'a>
        = D::TxToken<'a>
    where
        Self: 'a;

    fn receive(&mut self, context: &mut Context<'_>) -> Option<(D::RxToken<'_>, D::TxToken<'_>)> {
        if self.left == 0 {
            // The stack goes on after the other tasks.
            context.waker().wake_by_ref();
            return None;
        }
        let received = self.card.receive(context);
        self.left -= u8::from(received.is_some());
        received
    }

    fn transmit(&mut self, context: &mut Context<'_>) -> Option<D::TxToken<'_>> {
        self.card.transmit(context)
    }

    /// The stack asks once whenever it runs, after the frames.
    fn link_state(&mut self, context: &mut Context<'_>) -> LinkState {
        self.left = FRAMES;
        self.card.link_state(context)
    }

    fn capabilities(&self) -> Capabilities {
        self.card.capabilities()
    }

    fn hardware_address(&self) -> HardwareAddress {
        self.card.hardware_address()
    }
}
