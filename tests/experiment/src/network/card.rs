//! The target's network card: an end of the cable as embassy-net wants it.

use core::task::Context;

use embassy_net_driver::{Capabilities, Driver, HardwareAddress, LinkState, RxToken, TxToken};

use super::addresses::TARGET_CARD;
use super::cable::{Cable, FRAME_BYTES};

/// The target's end. It wakes nobody: wake the task of the network after sending.
pub struct Card<'a>(pub &'a Cable);

/// A frame that arrived.
pub struct Received<'a>(&'a Cable);

/// Room for a frame.
pub struct Room<'a>(&'a Cable);

impl RxToken for Received<'_> {
    fn consume<R, F: FnOnce(&mut [u8]) -> R>(self, read: F) -> R {
        let taken = self.0.to_target.take(read);
        taken.expect("`receive` saw the frame")
    }
}

impl TxToken for Room<'_> {
    fn consume<R, F: FnOnce(&mut [u8]) -> R>(self, bytes: usize, write: F) -> R {
        self.0.send(&self.0.to_host, bytes, write)
    }
}

impl Driver for Card<'_> {
    type RxToken<'a>
        = Received<'a>
    where
        Self: 'a;
    type TxToken<'a>
        = Room<'a>
    where
        Self: 'a;

    fn receive(&mut self, _: &mut Context<'_>) -> Option<(Received<'_>, Room<'_>)> {
        (self.0.to_target.len() > 0).then_some((Received(self.0), Room(self.0)))
    }

    fn transmit(&mut self, _: &mut Context<'_>) -> Option<Room<'_>> {
        Some(Room(self.0))
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
        HardwareAddress::Ethernet(TARGET_CARD)
    }
}
