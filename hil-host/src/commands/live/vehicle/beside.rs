//! The vehicle as new beside the vehicle, in the real-time thread.

use dashpot_live::{Change, Simulation, flags};
use dashpot_realtime::handover::Sender;
use dashpot_vehicle_run::VehicleRunError;

use super::tick::Tick;

/// The vehicle as new, if it is there.
#[derive(Default)]
pub(super) struct Beside {
    simulation: Option<Box<Simulation>>,
    comparisons: u32,
}

impl Beside {
    /// Goes on with another vehicle as new, or with none; returns the one before, because this thread must not free it.
    pub fn replace(
        &mut self,
        mut simulation: Option<Box<Simulation>>,
        main: &Simulation,
    ) -> Option<Box<Simulation>> {
        if let Some(simulation) = &mut simulation {
            simulation.follow(main);
            self.comparisons += 1;
        }
        std::mem::replace(&mut self.simulation, simulation)
    }

    /// Number of the comparison, from 1; 0 without.
    pub fn comparison(&self) -> u32 {
        self.simulation.as_ref().map_or(0, |_| self.comparisons)
    }

    /// Takes over a change, unless it changes a damper: the dampers of this vehicle stay as new.
    ///
    /// # Errors
    /// See [`Simulation::apply`].
    pub fn apply(&mut self, change: &Change) -> Result<(), VehicleRunError> {
        match (&mut self.simulation, change) {
            (None, _) | (_, Change::Damper { .. }) => Ok(()),
            (Some(simulation), change) => simulation.apply(change),
        }
    }

    /// Makes a tick, if the vehicle as new is there and has not ended.
    ///
    /// # Errors
    /// See [`Simulation::step`].
    pub fn step(&mut self, epoch: u32, ticks: &mut Sender<Tick>) -> Result<(), VehicleRunError> {
        let epoch = (epoch, self.comparison());
        if let Some(simulation) = &mut self.simulation
            && simulation.step()?
        {
            let ended = simulation.ending().map_or(0, |_| flags::ENDED);
            let put = |tick: &mut Tick| tick.put(epoch, 1, simulation.run(), 0, ended);
            // If nobody receives ticks any more, the tick of the vehicle, which follows, notices it.
            let _sent = ticks.send_or_skip(put);
        }
        Ok(())
    }
}
