//! The end of the thread that steps: waits in virtual time, and takes over calibrated dampers.

use std::sync::Arc;
use std::time::Duration;

use dashpot_host_link::xcp::Gate;
use dashpot_vehicle_run::{Ending, Run, VehicleRunError};

use super::slot::Slot;
use crate::commands::interruption;
use crate::commands::vehicle::drive::Exchange;

/// An exchange with external dampers, before which the vehicle waits for a measurement and takes over dampers.
pub(in crate::commands::vehicle) struct Stepping<'a, E> {
    pub(super) inner: &'a mut E,
    pub(super) slot: Arc<Slot>,
    /// `None` in real time.
    pub(super) gate: Option<Arc<Gate>>,
}

impl<E: Exchange> Exchange for Stepping<'_, E> {
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError> {
        if let Some(gate) = &self.gate {
            gate.pass(interruption::is_wanted);
        }
        self.slot.take(run)?;
        self.inner.before(run)
    }

    fn after(&mut self, run: &mut Run, time_left: impl Fn() -> Duration) -> Option<Ending> {
        self.inner.after(run, time_left)
    }
}
