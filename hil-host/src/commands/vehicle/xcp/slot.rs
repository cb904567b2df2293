//! Passes built dampers to the thread that steps, which neither waits nor allocates.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, TryLockError};

use dashpot_core::Damper;
use dashpot_vehicle_run::{Run, VehicleRunError};

/// A built damper and its index in the vehicle.
pub(super) type Built = (usize, Box<Damper<f64>>);

/// Dampers that the vehicle takes over before its next tick.
#[derive(Default)]
pub(super) struct Slot {
    has_new: AtomicBool,
    dampers: Mutex<Dampers>,
}

#[derive(Default)]
struct Dampers {
    new: Vec<Built>,
    /// Taken over; their memory is freed by the other thread.
    spent: Vec<Built>,
}

impl Slot {
    /// Replaces dampers, all in the same tick. One that is still waiting is replaced too.
    pub fn put(&self, built: Vec<Built>) {
        let dampers = self.dampers.lock();
        let mut dampers = dampers.unwrap_or_else(PoisonError::into_inner);
        dampers.spent.clear();
        for damper in built {
            dampers.new.retain(|(index, _)| *index != damper.0);
            dampers.new.push(damper);
        }
        self.has_new.store(true, Ordering::Release);
    }

    /// Lets the vehicle take over what is new. If the other thread is putting more, the next tick takes it over.
    ///
    /// # Errors
    /// None are known: the dampers were built for this vehicle.
    pub fn take(&self, run: &mut Run) -> Result<(), VehicleRunError> {
        if !self.has_new.load(Ordering::Acquire) {
            return Ok(());
        }
        let mut dampers = match self.dampers.try_lock() {
            Ok(dampers) => dampers,
            Err(TryLockError::Poisoned(error)) => error.into_inner(),
            Err(TryLockError::WouldBlock) => return Ok(()),
        };
        for (index, built) in &dampers.new {
            run.put_damper(*index, built)?;
        }
        // Nothing is spent yet: whoever puts new dampers frees the spent ones.
        let Dampers { new, spent } = &mut *dampers;
        std::mem::swap(new, spent);
        self.has_new.store(false, Ordering::Release);
        Ok(())
    }
}
