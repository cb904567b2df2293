//! Vehicle as part of another simulation: forces of the external dampers, speed, friction and forces on bodies are
//! inputs, signals are outputs.

use std::collections::HashSet;
use std::sync::Arc;

use dashpot_core::DamperParameters;
use dashpot_rail::contact::Tables;
use dashpot_rail::vehicle::VehicleState;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::contact::ContactSetup;
use super::recorded::all_signals;
use super::signals::Signal;
use super::{Ending, Input, Run, VehicleRunError, outside_index};
use dashpot_files::case::Case;

/// Everything that defines a coupled vehicle except its contact tables; can be serialized completely.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoupledCase {
    /// Version of Dashpot that wrote the case; only this version can read it.
    pub version: String,
    /// Case whose track refers to no other file.
    pub case: Case,
    /// Names of the external dampers.
    pub outside: Vec<String>,
}

impl CoupledCase {
    /// Name of the file that contains the coupled case in the resources of an FMU.
    pub const FILE: &str = "case.json";

    /// SHA-256 of the content of [`Self::FILE`], in hexadecimal. The library of an FMU rejects any other case.
    pub fn digest(content: &[u8]) -> String {
        dashpot_files::hexadecimal(&Sha256::digest(content))
    }

    /// Selects the external dampers of a case by name.
    ///
    /// # Errors
    /// A damper that cannot be external, or an invalid track.
    pub fn new(case: &Case, outside: &[String]) -> Result<Self, VehicleRunError> {
        outside_indices(case, outside)?;
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            case: Case {
                track: case.track.resolved()?,
                ..case.clone()
            },
            outside: outside.to_vec(),
        })
    }

    /// Returns the inputs that determine the contact and its tables.
    ///
    /// # Errors
    /// Invalid vehicle.
    pub fn contact(&self) -> Result<ContactSetup, VehicleRunError> {
        Ok(ContactSetup::of_case(&self.case)?)
    }
}

/// Returns the indices of the dampers with these names.
fn outside_indices(case: &Case, names: &[String]) -> Result<Vec<usize>, VehicleRunError> {
    let mut indices = Vec::new();
    for name in names {
        let index = outside_index(case, name, &indices).map_err(|source| {
            let name = name.clone();
            VehicleRunError::Outside { name, source }
        })?;
        indices.push(index);
    }
    Ok(indices)
}

/// Input or output variable of a coupled vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledVariable {
    /// Name of the signal, which ends in the unit unless it has none.
    pub name: String,
    /// Source or destination of the value.
    role: Role,
}

#[derive(Debug, Clone, PartialEq)]
enum Role {
    Input(Input),
    Output(Signal),
}

impl CoupledVariable {
    /// The input that this variable is; `None` for an output.
    pub fn input(&self) -> Option<Input> {
        match self.role {
            Role::Input(input) => Some(input),
            Role::Output(_) => None,
        }
    }
}

/// Vehicle whose external dampers are computed by another simulation.
///
/// Displacements are available at the end of a tick. A force that is then set acts at the end of the next tick, so it
/// lags the displacement from which it was computed by one tick.
#[derive(Debug, Clone)]
pub struct Coupled {
    start: Run,
    run: Run,
    /// State before the ticks of the current call of [`Coupled::step`].
    before: VehicleState,
    variables: Arc<[CoupledVariable]>,
    ending: Option<Ending>,
}

impl Coupled {
    /// Places the vehicle at the start of its case. `tables` are those of the pairs of [`CoupledCase::contact`].
    ///
    /// # Errors
    /// Case of another version, invalid vehicle, unknown damper, or two signals with the same name.
    pub fn new(coupled: &CoupledCase, tables: &[Arc<Tables>]) -> Result<Self, VehicleRunError> {
        if coupled.version != env!("CARGO_PKG_VERSION") {
            let version = coupled.version.clone();
            return Err(VehicleRunError::Version { version });
        }
        let case = &coupled.case;
        let contacts = coupled.contact()?.contacts(tables)?;
        let mut run = Run::on(case, contacts, Arc::new(case.track.build()?))?;
        let outside = outside_indices(case, &coupled.outside)?;
        for damper in &outside {
            run.state_mut().set_outside_force_n(*damper, Some(0.0))?;
        }
        let inputs = Input::all(run.vehicle(), &outside);
        let mut variables: Vec<CoupledVariable> = inputs
            .into_iter()
            .map(|input| CoupledVariable {
                name: input.name(run.vehicle()),
                role: Role::Input(input),
            })
            .collect();
        let is_outside = |signal: &Signal| outside.iter().any(|damper| signal.is_force_of(*damper));
        for signal in all_signals(&run, &case.vehicle) {
            let name = signal.name().to_owned();
            // The surrounding simulation supplies the time.
            if name != "time_s" && !is_outside(&signal) {
                let role = Role::Output(signal);
                variables.push(CoupledVariable { name, role });
            }
        }
        let mut names = HashSet::new();
        if let Some(duplicate) = variables
            .iter()
            .find(|variable| !names.insert(&variable.name))
        {
            let name = duplicate.name.clone();
            return Err(VehicleRunError::SameName { name });
        }
        Ok(Self {
            before: run.state().clone(),
            start: run.clone(),
            run,
            variables: variables.into(),
            ending: None,
        })
    }

    /// Variables: all inputs, then all signals of the vehicle except the time and the forces of external dampers.
    pub fn variables(&self) -> &[CoupledVariable] {
        &self.variables
    }

    /// Step size of the case, s.
    pub fn step_s(&self) -> f64 {
        self.run.vehicle().step_s()
    }

    /// Duration of the case, s.
    pub fn duration_s(&self) -> f64 {
        self.run.ticks() as f64 * self.step_s()
    }

    /// Time since the start, s.
    pub fn time_s(&self) -> f64 {
        self.run.time_s()
    }

    /// Returns to the start of the case, with the inputs that it has there; external dampers have no force.
    pub fn reset(&mut self) {
        self.run.clone_from(&self.start);
        self.ending = None;
    }

    /// Value of the variable with index `index`; `None` if there is no such variable.
    pub fn value(&self, index: usize) -> Option<f64> {
        Some(match &self.variables.get(index)?.role {
            Role::Input(input) => input.value(self.run.state()),
            Role::Output(signal) => signal.value(self.run.state(), self.run.time_s()),
        })
    }

    /// Sets an input for all following ticks; `index` is that of the variable. An event of the case that changes the
    /// same quantity later replaces the value.
    ///
    /// # Errors
    /// The variable is not an input, or the value is not allowed. On an error, nothing changes.
    pub fn set(&mut self, index: usize, value: f64) -> Result<(), VehicleRunError> {
        let variable = self.variables.get(index);
        let Some(input) = variable.and_then(CoupledVariable::input) else {
            return Err(VehicleRunError::NotAnInput { variable: index });
        };
        input.set(self.run.state_mut(), value)
    }

    /// Replaces a damper of the vehicle from the next tick on; its force stays continuous. [`Self::reset`] and
    /// [`Self::restore`] bring back the case's dampers.
    ///
    /// # Errors
    /// No damper of this name, or parameters that cannot be built for the step of the case.
    pub fn replace_damper(
        &mut self,
        name: &str,
        parameters: &DamperParameters,
    ) -> Result<(), VehicleRunError> {
        self.run.replace_damper(name, parameters)
    }

    /// Simulates up to `ticks` ticks, fewer if the run ends, and returns their number. If the run diverges, the state
    /// before the call is restored.
    ///
    /// # Errors
    /// See [`Run::step`].
    pub fn step(&mut self, ticks: u64) -> Result<u64, VehicleRunError> {
        self.before.clone_from(self.run.state());
        for tick in 0..ticks {
            if self.ending.is_some() {
                return Ok(tick);
            }
            self.ending = self.run.step()?;
            match self.ending {
                Some(Ending::Completed) => return Ok(tick),
                Some(Ending::Diverged { .. }) => {
                    self.run.state_mut().clone_from(&self.before);
                    return Ok(0);
                }
                _ => {}
            }
        }
        Ok(ticks)
    }

    /// Saves the state as bytes for [`Self::restore`]. Their number grows slightly with the tick count, by less than
    /// half.
    ///
    /// # Errors
    /// None are known.
    pub fn save(&self) -> Result<Vec<u8>, postcard::Error> {
        postcard::to_stdvec(&(self.run.state(), self.ending_code()))
    }

    /// Resumes from bytes saved by a vehicle of the same case.
    ///
    /// # Errors
    /// The bytes are not a state of this vehicle. On an error, nothing changes.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), postcard::Error> {
        let (state, ending): (VehicleState, i32) = postcard::from_bytes(bytes)?;
        let invalid = |_| postcard::Error::DeserializeBadEncoding;
        self.run.restore(&self.start, state).map_err(invalid)?;
        self.ending = match ending {
            0 => None,
            1 => Some(Ending::Completed),
            4 => Some(self.run.diverged()),
            _ => self.run.ending(),
        };
        Ok(())
    }

    /// Ending as a number: 0 not ended, 1 case completed, 2 a wheel climbed the rail, 3 outside the contact tables, 4
    /// diverged, 5 beyond the model, 6 overturned.
    pub fn ending_code(&self) -> i32 {
        match &self.ending {
            None => 0,
            Some(
                Ending::Completed
                | Ending::Interrupted { .. }
                | Ending::OutsideLost { .. }
                | Ending::GuardEnded { .. }
                | Ending::SlowTick { .. },
            ) => 1,
            Some(Ending::Climbed { .. }) => 2,
            Some(Ending::OutsideTables { .. }) => 3,
            Some(Ending::Diverged { .. } | Ending::Numerical { .. }) => 4,
            Some(Ending::BeyondModel { .. }) => 5,
            Some(Ending::Overturned { .. }) => 6,
        }
    }

    /// Ending of the run, if it has ended.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }
}
