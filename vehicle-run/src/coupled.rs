//! A vehicle as a part of another simulation: forces of the dampers outside go in, ticks are taken, signals come out.

use std::collections::HashSet;
use std::sync::Arc;

use dashpot_rail::contact::Tables;
use dashpot_rail::vehicle::VehicleState;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::contact::{self, ContactOf};
use super::recorded::all_signals;
use super::signals::{Signal, slug};
use super::{Ending, Run, VehicleRunError, number_outside};
use dashpot_files::case::Case;

/// What a coupled vehicle is made of but for the tables of its contact; whole when it is written by serde.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoupledCase {
    /// Version of Dashpot that it was written by, and is read by.
    pub version: String,
    /// The case; its track needs no other file.
    pub case: Case,
    /// Names of the dampers outside.
    pub outside: Vec<String>,
}

impl CoupledCase {
    /// Name of the file that holds it in the resources of an FMU.
    pub const FILE: &str = "case.json";

    /// SHA-256 of the content of [`Self::FILE`], in hexadecimal: the library of an FMU refuses any other case.
    pub fn digest(content: &[u8]) -> String {
        let digest = Sha256::digest(content);
        digest.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Of a case, with these dampers outside.
    ///
    /// # Errors
    /// A damper that cannot be outside; a track that is refused.
    pub fn new(case: &Case, outside: &[String]) -> Result<Self, VehicleRunError> {
        numbers_outside(case, outside)?;
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            case: Case {
                track: case.track.resolved()?,
                ..case.clone()
            },
            outside: outside.to_vec(),
        })
    }

    /// What the tables of the contact follow from.
    ///
    /// # Errors
    /// A vehicle that is refused.
    pub fn contact(&self) -> Result<ContactOf, VehicleRunError> {
        let case = &self.case;
        let damping_s_per_m = case.normal_damping_s_per_m;
        Ok(ContactOf::new(
            &case.vehicle,
            case.friction,
            damping_s_per_m,
        )?)
    }
}

/// Numbers of the dampers of these names.
fn numbers_outside(case: &Case, names: &[String]) -> Result<Vec<usize>, VehicleRunError> {
    let mut numbers = Vec::new();
    for name in names {
        let number = number_outside(case, name, &numbers).map_err(|source| {
            let name = name.clone();
            VehicleRunError::Outside { name, source }
        })?;
        numbers.push(number);
    }
    Ok(numbers)
}

/// A number of a coupled vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledVariable {
    /// That of the signal, with the unit.
    pub name: String,
    /// Where it goes or comes from.
    role: Role,
}

#[derive(Debug, Clone, PartialEq)]
enum Role {
    /// Force of a damper outside, by its place among them.
    Force(usize),
    /// Rate of its displacement over the last tick.
    Velocity(usize),
    Output(Signal),
}

impl CoupledVariable {
    /// Whether it is the force of a damper outside, which others set.
    pub fn is_force(&self) -> bool {
        matches!(self.role, Role::Force(_))
    }
}

/// A damper outside.
#[derive(Debug, Clone)]
struct Outside {
    number: usize,
    force_n: f64,
    /// Displacement a tick ago, m.
    last_m: f64,
}

/// A vehicle whose dampers outside are others' to compute.
///
/// The displacement of a tick is told at its end; a force that is set acts at the end of the next: one tick after the displacement that
/// it answers, as with `dashpot vehicle --outside`.
#[derive(Debug, Clone)]
pub struct Coupled {
    start: Run,
    run: Run,
    /// Before the ticks that are taken at once.
    before: VehicleState,
    variables: Arc<[CoupledVariable]>,
    outside: Vec<Outside>,
    ending: Option<Ending>,
}

impl Coupled {
    /// At the start of its case, with the contact that [`CoupledCase::contact`] says and its tables.
    ///
    /// # Errors
    /// A case of another version; a vehicle that is refused; a damper that is not the vehicle's; two signals of one name.
    pub fn new(of: &CoupledCase, tables: Arc<Tables>) -> Result<Self, VehicleRunError> {
        if of.version != env!("CARGO_PKG_VERSION") {
            let version = of.version.clone();
            return Err(VehicleRunError::Version { version });
        }
        let case = &of.case;
        let contact = contact::with(tables, &of.contact()?)?;
        let mut run = Run::on(case, contact, Arc::new(case.track.build()?))?;
        let names: Vec<String> = run.vehicle().damper_names().map(str::to_owned).collect();
        let numbers = numbers_outside(&of.case, &of.outside)?;
        let outside: Vec<Outside> = numbers
            .into_iter()
            .map(|number| {
                run.state_mut().set_outside_force_n(number, Some(0.0))?;
                Ok(Outside {
                    number,
                    force_n: 0.0,
                    last_m: run.state().damper_displacements_m()[number],
                })
            })
            .collect::<Result<_, VehicleRunError>>()?;
        let mut variables = Vec::new();
        for (place, damper) in outside.iter().enumerate() {
            let name = slug(&names[damper.number]);
            let roles = [
                ("force_n", Role::Force(place)),
                ("velocity_m_per_s", Role::Velocity(place)),
            ];
            variables.extend(roles.map(|(what, role)| CoupledVariable {
                name: format!("{name}_{what}"),
                role,
            }));
        }
        let is_outside = |signal: &Signal| {
            outside
                .iter()
                .any(|damper| signal.is_force_of(damper.number))
        };
        for signal in all_signals(&run, &of.case.vehicle) {
            let name = signal.name().to_owned();
            // The simulation around it has the time.
            if name != "time_s" && !is_outside(&signal) {
                let role = Role::Output(signal);
                variables.push(CoupledVariable { name, role });
            }
        }
        let mut names = HashSet::new();
        if let Some(twice) = variables
            .iter()
            .find(|variable| !names.insert(&variable.name))
        {
            let name = twice.name.clone();
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

    /// Its numbers: force and velocity of each damper outside, then every signal of the vehicle but the time.
    pub fn variables(&self) -> &[CoupledVariable] {
        &self.variables
    }

    /// Step of the case, s.
    pub fn step_s(&self) -> f64 {
        self.run.vehicle().step_s()
    }

    /// When the case is over, s after its start.
    pub fn duration_s(&self) -> f64 {
        self.run.ticks() as f64 * self.step_s()
    }

    /// At the start again, without forces outside.
    pub fn reset(&mut self) {
        self.run.clone_from(&self.start);
        self.ending = None;
        let displacements_m = self.run.state().damper_displacements_m();
        for damper in &mut self.outside {
            damper.force_n = 0.0;
            damper.last_m = displacements_m[damper.number];
        }
    }

    /// The number of a variable, by its place.
    pub fn number(&self, place: usize) -> Option<f64> {
        Some(match &self.variables.get(place)?.role {
            Role::Force(outside) => self.outside[*outside].force_n,
            Role::Velocity(outside) => {
                let damper = &self.outside[*outside];
                let displacements_m = self.run.state().damper_displacements_m();
                (displacements_m[damper.number] - damper.last_m) / self.step_s()
            }
            Role::Output(signal) => signal.of(self.run.state(), self.run.time_s()),
        })
    }

    /// Sets the force of a damper outside, N, by the variable's place, for all ticks that come.
    ///
    /// # Errors
    /// A variable that is not the force of a damper outside, a force that is not finite; then nothing changes.
    pub fn set_force_n(&mut self, place: usize, force_n: f64) -> Result<(), VehicleRunError> {
        let role = self.variables.get(place).map(|variable| &variable.role);
        let Some(Role::Force(outside)) = role else {
            return Err(VehicleRunError::NotAForce { variable: place });
        };
        let damper = &mut self.outside[*outside];
        let state = self.run.state_mut();
        state.set_outside_force_n(damper.number, Some(force_n))?;
        damper.force_n = force_n;
        Ok(())
    }

    /// Takes up to `ticks` ticks, fewer where the run ends: how many it took. One that diverges stays where it was before the call.
    ///
    /// # Errors
    /// As [`Run::step`].
    pub fn step(&mut self, ticks: u64) -> Result<u64, VehicleRunError> {
        self.before.clone_from(self.run.state());
        let last_m: Vec<f64> = self.outside.iter().map(|damper| damper.last_m).collect();
        for tick in 0..ticks {
            if self.ending.is_some() {
                return Ok(tick);
            }
            let displacements_m = self.run.state().damper_displacements_m();
            for damper in &mut self.outside {
                damper.last_m = displacements_m[damper.number];
            }
            self.ending = self.run.step()?;
            match self.ending {
                Some(Ending::Completed) => return Ok(tick),
                Some(Ending::Diverged { .. }) => {
                    self.run.state_mut().clone_from(&self.before);
                    for (damper, last_m) in self.outside.iter_mut().zip(last_m) {
                        damper.last_m = last_m;
                    }
                    return Ok(0);
                }
                _ => {}
            }
        }
        Ok(ticks)
    }

    /// All that changes, as bytes for [`Self::restore`]; their number grows with the numbers of ticks, by less than half.
    ///
    /// # Errors
    /// None that is known.
    pub fn saved(&self) -> Result<Vec<u8>, postcard::Error> {
        let of_damper = |damper: &Outside| [damper.force_n, damper.last_m];
        let outside: Vec<[f64; 2]> = self.outside.iter().map(of_damper).collect();
        postcard::to_stdvec(&(self.run.state(), outside, self.ending_number()))
    }

    /// Goes on from bytes that a vehicle of the same case has saved.
    ///
    /// # Errors
    /// Bytes that are no state of this vehicle; then nothing changes.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), postcard::Error> {
        let (state, outside, ending): (VehicleState, Vec<[f64; 2]>, i32) =
            postcard::from_bytes(bytes)?;
        let refused = |_| postcard::Error::DeserializeBadEncoding;
        if outside.len() != self.outside.len() {
            return Err(postcard::Error::DeserializeBadEncoding);
        }
        self.run.restore(&self.start, state).map_err(refused)?;
        for (damper, [force_n, last_m]) in self.outside.iter_mut().zip(outside) {
            (damper.force_n, damper.last_m) = (force_n, last_m);
        }
        self.ending = match ending {
            0 => None,
            1 => Some(Ending::Completed),
            4 => Some(self.run.diverged()),
            _ => self.run.ending(),
        };
        Ok(())
    }

    /// How it ended in a number: 0 not yet, 1 the case is over, 2 derailed, 3 outside the tables of the contact, 4 diverged, 5 beyond the
    /// model, 6 overturned.
    pub fn ending_number(&self) -> i32 {
        match &self.ending {
            None => 0,
            Some(Ending::Completed | Ending::Interrupted { .. } | Ending::OutsideLost { .. }) => 1,
            Some(Ending::Derailed { .. }) => 2,
            Some(Ending::OutsideTables { .. }) => 3,
            Some(Ending::Diverged { .. }) => 4,
            Some(Ending::BeyondModel { .. }) => 5,
            Some(Ending::Overturned { .. }) => 6,
        }
    }

    /// How it ended, if it did.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }
}
