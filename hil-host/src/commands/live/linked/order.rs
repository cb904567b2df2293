//! Orders from the operator's side to the thread that talks with the target.

use dashpot_core::Damper;

use super::motion::Sine;

/// Orders that wait.
pub(super) const ORDERS: usize = 64;

/// Something that the thread does between two ticks.
#[derive(Debug)]
pub(super) enum Order {
    /// Another motion.
    Motion(Sine),
    /// Another damper in a slot.
    Damper {
        /// Slot, from 0.
        slot: usize,
        /// The new damper.
        damper: Box<Damper<f32>>,
    },
    /// Status bits and rejected inputs of all slots to zero.
    ClearStatus,
}
