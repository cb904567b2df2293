//! The solver on contact tables, compiled in this crate.

use dashpot_rail::contact::Tables;
use dashpot_rail::creep::KalkerBook;

use super::{VehicleReference, VehicleSample};
use crate::error::ReferenceError;

impl VehicleReference<'_, KalkerBook, Tables> {
    /// Runs the vehicle like [`VehicleReference::run_each`].
    ///
    /// A generic function is compiled in the crate that calls it, with that crate's optimisation. This one is compiled
    /// here, and up to ten times as fast as one that is compiled with little optimisation.
    ///
    /// # Errors
    /// Those of [`VehicleReference::run`].
    pub fn run_on_tables(
        &mut self,
        times_s: &[f64],
        tolerance: f64,
        on_sample: &mut dyn FnMut(&VehicleSample),
    ) -> Result<(), ReferenceError> {
        self.run_each(times_s, tolerance, on_sample)
    }
}
