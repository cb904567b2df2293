//! Outputs and a stand-in for the watchdog, for images with the server of other boards.

use core::cell::RefCell;

use dashpot_core::link::Outputs;
use dashpot_device::{Progress, ProgressCheck};
use embassy_futures::yield_now;

use crate::bank::DAMPERS;
use crate::board::{self, CLOCK_HZ};
use crate::outputs::SerialOutputs;
use crate::safe_state;

/// Outputs that the server sets while [`send`] sends.
#[derive(Debug)]
pub struct SharedOutputs<'a>(pub &'a RefCell<SerialOutputs>);

impl Outputs<DAMPERS> for SharedOutputs<'_> {
    fn drive(&mut self, forces_n: &[f32; DAMPERS]) {
        self.0.borrow_mut().drive(forces_n);
    }
}

/// Sends the outputs for ever.
pub async fn send(outputs: &RefCell<SerialOutputs>) {
    loop {
        outputs.borrow_mut().send_waiting();
        yield_now().await;
    }
}

/// Stops the image if a watchdog of 100 ms would not be fed.
pub async fn watch(progress: &Progress) {
    let mut check = ProgressCheck::default();
    loop {
        let start = board::clock_now();
        while board::clock_now().wrapping_sub(start) < CLOCK_HZ / 10 {
            yield_now().await;
        }
        if !check.both_moved(progress) {
            safe_state::halt();
        }
    }
}
