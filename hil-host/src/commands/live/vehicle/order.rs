//! What passes between the operator's side and the real-time thread, through memory that both have from the start.

use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

use dashpot_live::{Change, Simulation};
use dashpot_vehicle_run::Ending;

/// Orders on their way to the real-time thread.
const ORDERS: usize = 64;

/// Something that the real-time thread takes over between two ticks.
#[derive(Debug)]
pub(super) enum Order {
    /// A change, at a tick or as soon as possible after it.
    Change {
        /// Number of ticks before it.
        at: u64,
        /// The change.
        change: Change,
    },
    /// Another speed of time; 0 pauses.
    Factor(f64),
    /// A few ticks while paused.
    Steps(u32),
    /// The vehicle as new, which goes on from where the vehicle is, beside it; or none any more. Returns the one that
    /// was there before.
    Compare(Option<Box<Simulation>>),
    /// Brings this one to where the vehicle is.
    Copy(Box<Simulation>),
    /// Another vehicle.
    Start {
        /// Number of the run, from 1.
        epoch: u32,
        /// The vehicle.
        simulation: Box<Simulation>,
    },
}

/// Something that the real-time thread says.
#[derive(Debug)]
pub(super) enum Note {
    /// An order that has been taken over, with memory that the real-time thread must not free.
    Spent(Order),
    /// The emergency stop has begun.
    Stopped,
    /// The run has ended.
    Ended(Ending),
}

/// Both ends of the two rings.
pub(super) struct Rings {
    pub to_ticks: SyncSender<Order>,
    pub orders: Receiver<Order>,
    pub notes: Receiver<Note>,
    pub to_desk: SyncSender<Note>,
}

/// Makes the rings.
pub(super) fn rings() -> Rings {
    let (to_ticks, orders) = sync_channel(ORDERS);
    // Each order gives one note, and few notes come without an order.
    let (to_desk, notes) = sync_channel(4 * ORDERS);
    Rings {
        to_ticks,
        orders,
        notes,
        to_desk,
    }
}
