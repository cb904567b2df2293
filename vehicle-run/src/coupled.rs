//! Vehicle as part of another simulation: forces of the external dampers are inputs, signals are outputs.

use std::collections::HashSet;
use std::sync::Arc;

use dashpot_rail::contact::Tables;
use dashpot_rail::vehicle::VehicleState;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::contact::ContactSetup;
use super::recorded::all_signals;
use super::signals::{Signal, slug};
use super::{Ending, Run, VehicleRunError, outside_index};
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
    /// Name of the signal, which ends in the unit.
    pub name: String,
    /// Source or destination of the value.
    role: Role,
}

#[derive(Debug, Clone, PartialEq)]
enum Role {
    /// Force of an external damper, by its index in `Coupled::outside`.
    Force(usize),
    Output(Signal),
}

impl CoupledVariable {
    /// True if this is the force of an external damper, which is an input.
    pub fn is_force(&self) -> bool {
        matches!(self.role, Role::Force(_))
    }
}

/// A damper whose force comes from another simulation.
#[derive(Debug, Clone)]
struct Outside {
    /// Index of the damper in the vehicle.
    index: usize,
    force_n: f64,
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
    outside: Vec<Outside>,
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
        let names: Vec<String> = run.vehicle().damper_names().map(str::to_owned).collect();
        let indices = outside_indices(case, &coupled.outside)?;
        let outside: Vec<Outside> = indices
            .into_iter()
            .map(|index| {
                run.state_mut().set_outside_force_n(index, Some(0.0))?;
                Ok(Outside {
                    index,
                    force_n: 0.0,
                })
            })
            .collect::<Result<_, VehicleRunError>>()?;
        let mut variables = Vec::new();
        for (slot, damper) in outside.iter().enumerate() {
            variables.push(CoupledVariable {
                name: format!("{}_force_n", slug(&names[damper.index])),
                role: Role::Force(slot),
            });
        }
        let is_outside = |signal: &Signal| {
            outside
                .iter()
                .any(|damper| signal.is_force_of(damper.index))
        };
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
            outside,
            ending: None,
        })
    }

    /// Variables: force of each external damper, then all other signals of the vehicle except the time.
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

    /// Returns to the start of the case and sets the forces of all external dampers to zero.
    pub fn reset(&mut self) {
        self.run.clone_from(&self.start);
        self.ending = None;
        for damper in &mut self.outside {
            damper.force_n = 0.0;
        }
    }

    /// Value of the variable with index `index`; `None` if there is no such variable.
    pub fn value(&self, index: usize) -> Option<f64> {
        Some(match &self.variables.get(index)?.role {
            Role::Force(slot) => self.outside[*slot].force_n,
            Role::Output(signal) => signal.value(self.run.state(), self.run.time_s()),
        })
    }

    /// Sets the force of an external damper, N, for all following ticks; `index` is that of the variable.
    ///
    /// # Errors
    /// The variable is not the force of an external damper, or the force is not finite. On an error, nothing changes.
    pub fn set_force_n(&mut self, index: usize, force_n: f64) -> Result<(), VehicleRunError> {
        let role = self.variables.get(index).map(|variable| &variable.role);
        let Some(Role::Force(slot)) = role else {
            return Err(VehicleRunError::NotAForce { variable: index });
        };
        let damper = &mut self.outside[*slot];
        let state = self.run.state_mut();
        state.set_outside_force_n(damper.index, Some(force_n))?;
        damper.force_n = force_n;
        Ok(())
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
        let outside: Vec<f64> = self.outside.iter().map(|damper| damper.force_n).collect();
        postcard::to_stdvec(&(self.run.state(), outside, self.ending_code()))
    }

    /// Resumes from bytes saved by a vehicle of the same case.
    ///
    /// # Errors
    /// The bytes are not a state of this vehicle. On an error, nothing changes.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), postcard::Error> {
        let (state, outside, ending): (VehicleState, Vec<f64>, i32) = postcard::from_bytes(bytes)?;
        let invalid = |_| postcard::Error::DeserializeBadEncoding;
        if outside.len() != self.outside.len() {
            return Err(postcard::Error::DeserializeBadEncoding);
        }
        self.run.restore(&self.start, state).map_err(invalid)?;
        for (damper, force_n) in self.outside.iter_mut().zip(outside) {
            damper.force_n = force_n;
        }
        self.ending = match ending {
            0 => None,
            1 => Some(Ending::Completed),
            4 => Some(self.run.diverged()),
            _ => self.run.ending(),
        };
        Ok(())
    }

    /// Ending as a number: 0 not ended, 1 case completed, 2 derailed, 3 outside the contact tables, 4 diverged, 5
    /// beyond the model, 6 overturned.
    pub fn ending_code(&self) -> i32 {
        match &self.ending {
            None => 0,
            Some(Ending::Completed | Ending::Interrupted { .. } | Ending::OutsideLost { .. }) => 1,
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
