//! A vehicle that runs until someone stops it, and takes over changes between two ticks.

use dashpot_files::case::Case;
use dashpot_rail::vehicle::{VehicleError, VehicleState};
use dashpot_vehicle_run::{Ending, Run, VehicleRunError};
use serde::{Deserialize, Serialize};

use crate::Change;
use crate::desk::Place;

/// Rate of a change of speed, m/s^2: a locomotive that pulls or brakes hard.
const SPEED_RATE_M_PER_S2: f64 = 1.0;

/// Rate of a change of the friction factor, 1/s.
const FRICTION_RATE_PER_S: f64 = 5.0;

/// Height above the rails at which a gust acts, m: about the middle of a car body's side.
const GUST_HEIGHT_M: f64 = 2.2;

/// What an operator moves while the vehicle runs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Inputs {
    /// `None` leaves the speed to the case.
    speed_m_per_s: Option<f64>,
    /// `None` leaves the friction to the case.
    friction_factor: Option<f64>,
    gust: Option<Gust>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Gust {
    force_n: f64,
    duration_s: f64,
    time_s: f64,
}

/// A running vehicle.
#[derive(Debug, Clone)]
pub struct Simulation {
    start: Run,
    run: Run,
    inputs: Inputs,
    step_s: f64,
    ending: Option<Ending>,
}

impl Simulation {
    /// A vehicle at its start. The case is that of [`endless`](crate::endless).
    pub fn new(case: &Case, run: Run) -> Self {
        Self {
            start: run.clone(),
            run,
            inputs: Inputs::default(),
            step_s: case.step_s,
            ending: None,
        }
    }

    /// Takes over a change from the next tick on. Does not allocate.
    ///
    /// # Errors
    /// None are known: the desk prepares changes of this vehicle only.
    pub fn apply(&mut self, change: &Change) -> Result<(), VehicleRunError> {
        match change {
            Change::Damper { index, built } => self.run.put_damper(*index, built)?,
            Change::Track(track) => self.run.put_track(track),
            Change::Speed(speed_m_per_s) => self.inputs.speed_m_per_s = Some(*speed_m_per_s),
            Change::Friction(factor) => self.inputs.friction_factor = Some(*factor),
            Change::Gust {
                force_n,
                duration_s,
            } => {
                self.inputs.gust = Some(Gust {
                    force_n: *force_n,
                    duration_s: *duration_s,
                    time_s: 0.0,
                });
            }
        }
        Ok(())
    }

    /// Simulates a tick; does nothing after the end. Returns true if it did.
    ///
    /// # Errors
    /// See [`Run::step`].
    pub fn step(&mut self) -> Result<bool, VehicleRunError> {
        if self.ending.is_some() {
            return Ok(false);
        }
        self.move_inputs()?;
        self.ending = self.run.step()?;
        Ok(true)
    }

    /// Sets speed, friction and wind of the next tick.
    fn move_inputs(&mut self) -> Result<(), VehicleError> {
        let state = self.run.state();
        let (speed, friction) = (state.speed_m_per_s(), state.friction_factor());
        let Inputs {
            speed_m_per_s,
            friction_factor,
            gust,
        } = self.inputs;
        if let Some(wanted) = speed_m_per_s
            && wanted != speed
        {
            let next = towards(speed, wanted, SPEED_RATE_M_PER_S2 * self.step_s);
            self.run.state_mut().set_speed_m_per_s(next)?;
        }
        if let Some(wanted) = friction_factor
            && wanted != friction
        {
            let next = towards(friction, wanted, FRICTION_RATE_PER_S * self.step_s);
            self.run.state_mut().set_friction_factor(next)?;
        }
        if let Some(mut gust) = gust {
            gust.time_s += self.step_s;
            let phase = std::f64::consts::TAU * (gust.time_s / gust.duration_s).min(1.0);
            let lateral_n = 0.5 * gust.force_n * (1.0 - libm::cos(phase));
            let force =
                self.run
                    .vehicle()
                    .about_centre(0, [0.0, 0.0, GUST_HEIGHT_M], [lateral_n, 0.0]);
            self.run.state_mut().apply(0, force.unwrap_or_default())?;
            self.inputs.gust = (gust.time_s < gust.duration_s).then_some(gust);
        }
        Ok(())
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The run, for dampers whose force comes from outside.
    pub fn run_mut(&mut self) -> &mut Run {
        &mut self.run
    }

    /// Where the vehicle is.
    pub fn place(&self) -> Place {
        Place {
            tick: self.run.state().ticks(),
            distance_m: self.run.state().distance_m(),
        }
    }

    /// How the run ended, if it did.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// Returns to the start, with the parameters of the case.
    pub fn reset(&mut self) {
        self.run.clone_from(&self.start);
        self.inputs = Inputs::default();
        self.ending = None;
    }

    /// Goes on from where another run of the same vehicle on the same track is, with the dampers of this one. Does not
    /// allocate.
    pub fn follow(&mut self, other: &Self) {
        self.run.state_mut().clone_from(other.run.state());
        self.inputs = other.inputs;
        self.ending = None;
    }

    /// What the operator moves.
    pub(crate) fn inputs(&self) -> Inputs {
        self.inputs
    }

    /// Resumes from a state and inputs of the same vehicle; the changes of parameters follow.
    ///
    /// # Errors
    /// State of another vehicle. On an error, nothing changes.
    pub(crate) fn restore(
        &mut self,
        state: VehicleState,
        inputs: Inputs,
    ) -> Result<(), VehicleRunError> {
        self.run.restore(&self.start, state)?;
        self.inputs = inputs;
        self.ending = None;
        Ok(())
    }
}

/// Moves a value towards another by at most `most`.
fn towards(value: f64, to: f64, most: f64) -> f64 {
    value + (to - value).clamp(-most, most)
}
