//! The operator's side: checks actions and prepares what the running vehicle takes over between two ticks.

use std::sync::Arc;

use dashpot_core::{Damper, DamperParameters};
use dashpot_files::case::Case;
use dashpot_files::damper::{self, DamperError, KeyedParameters, PRESETS};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::{Defect, Track};
use dashpot_rail::vehicle::{FRICTION_FACTOR, Law, Vehicle};
use dashpot_vehicle_run::{Run, VehicleRunError};

use crate::defect::{AHEAD_M, DEFECTS, defect};
use crate::error::within;
use crate::fault::{FAULTS, FaultKind};
use crate::outline::wheelbase;
use crate::quantity::{WEAR, worn};
use crate::unknown_name::UnknownName;
use crate::{Action, ActionError};

/// Speeds that an operator may choose, km/h.
pub const SPEED_KM_H: [f64; 2] = [10.0, 350.0];

/// Largest force of a gust, N.
const GUST_N: f64 = 300e3;

/// Durations of a gust, s.
const GUST_S: [f64; 2] = [0.1, 60.0];

/// What the running vehicle takes over between two ticks, without allocating.
#[derive(Debug, Clone)]
pub enum Change {
    /// A built damper.
    Damper {
        /// Index of the damper.
        index: usize,
        /// Its constants.
        built: Box<Damper<f64>>,
    },
    /// A track that differs only ahead of the vehicle.
    Track(Arc<Track>),
    /// Speed to reach, m/s.
    Speed(f64),
    /// Factor on the friction to reach.
    Friction(f64),
    /// Gust on the first body.
    Gust {
        /// Greatest force, N.
        force_n: f64,
        /// Duration, s.
        duration_s: f64,
    },
}

/// Where the vehicle is when an action happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Ticks since the start.
    pub tick: u64,
    /// Position of the vehicle's middle along the track, m.
    pub distance_m: f64,
}

/// A damper on the desk.
#[derive(Debug, Clone)]
struct DeskDamper {
    name: String,
    as_new: KeyedParameters,
    /// As new, or the preset in its place; the sliders have their ranges around it.
    usual: KeyedParameters,
    now: KeyedParameters,
    fault: Option<&'static str>,
    wear: f64,
    is_changed: bool,
}

/// Checks and prepares actions; knows the parameters of everything that they may change.
#[derive(Debug, Clone)]
pub struct Desk {
    case: Case,
    vehicle: Vehicle<KalkerBook>,
    dampers: Vec<DeskDamper>,
    defects: Vec<Defect>,
    actions: Vec<(u64, Action)>,
    speed_km_h: f64,
    friction_factor: f64,
    leading_m: f64,
}

impl Desk {
    /// The desk of a run of `case`, whose irregularities are generated, before its first tick.
    ///
    /// # Errors
    /// A damper that cannot be written as a file.
    pub fn new(case: &Case, run: &Run) -> Result<Self, ActionError> {
        let case = case.clone();
        let dampers = case
            .vehicle
            .dampers()
            .filter_map(|element| match &element.law {
                Law::Damper { parameters, .. } => Some((&element.name, parameters)),
                _ => None,
            });
        let dampers = dampers.map(|(name, parameters)| {
            let as_new = KeyedParameters::new(name, parameters)?;
            Ok(DeskDamper {
                name: name.clone(),
                now: as_new.clone(),
                usual: as_new.clone(),
                as_new,
                fault: None,
                wear: 0.0,
                is_changed: false,
            })
        });
        Ok(Self {
            dampers: dampers.collect::<Result<_, DamperError>>()?,
            vehicle: run.vehicle().clone(),
            defects: case.track.defects.clone(),
            actions: Vec::new(),
            speed_km_h: 3.6 * case.speed_m_per_s,
            friction_factor: 1.0,
            leading_m: wheelbase(&case.vehicle)[1],
            case,
        })
    }

    /// The case, with its irregularities already generated.
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// Actions so far, each with the number of ticks before it.
    pub fn actions(&self) -> &[(u64, Action)] {
        &self.actions
    }

    /// Speed that the operator wants, km/h.
    pub fn speed_km_h(&self) -> f64 {
        self.speed_km_h
    }

    /// Factor on the friction that the operator wants.
    pub fn friction_factor(&self) -> f64 {
        self.friction_factor
    }

    /// Number of dampers.
    pub fn dampers(&self) -> usize {
        self.dampers.len()
    }

    /// Parameters of a damper as new.
    pub(crate) fn as_new(&self, damper: usize) -> &KeyedParameters {
        &self.dampers[damper].as_new
    }

    /// Parameters around which a damper's numbers are chosen.
    pub(crate) fn usual(&self, damper: usize) -> &KeyedParameters {
        &self.dampers[damper].usual
    }

    /// Present parameters of a damper.
    pub(crate) fn now(&self, damper: usize) -> &KeyedParameters {
        &self.dampers[damper].now
    }

    /// True if a damper differs from itself as new, its fault, and its wear.
    pub(crate) fn condition(&self, damper: usize) -> (bool, Option<&'static str>, f64) {
        let damper = &self.dampers[damper];
        (damper.is_changed, damper.fault, damper.wear)
    }

    /// Checks an action and prepares its change.
    ///
    /// # Errors
    /// Unknown names, or values that are not allowed. On an error, nothing changes.
    pub fn act(&mut self, action: &Action, place: Place) -> Result<Change, ActionError> {
        let change = match action {
            Action::Damper { damper, key, value } if key == WEAR => {
                within(WEAR, *value, [0.0, 1.0])?;
                let numbers = worn(&self.dampers[self.damper(damper)?].as_new, *value);
                self.change_as_new(damper, &numbers, |desk| {
                    (desk.fault, desk.wear) = (None, *value)
                })?
            }
            Action::Damper { damper, key, value } => {
                let index = self.damper(damper)?;
                let checked = self.dampers[index].now.with(&[(key, *value)])?;
                self.put(index, &checked, |_| ())?
            }
            Action::Preset { damper, preset } => {
                let index = self.damper(damper)?;
                let names = || PRESETS.iter().map(|(name, _)| *name);
                if !names().any(|name| name == preset) {
                    return Err(UnknownName::new("preset", preset, names()).into());
                }
                let loaded = damper::load(preset, &[])?;
                self.put(index, &loaded, |desk| {
                    desk.usual = desk.now.clone();
                    (desk.fault, desk.wear) = (None, 0.0);
                })?
            }
            Action::AsNew { damper } => self.change_as_new(damper, &[], |desk| {
                (desk.fault, desk.wear, desk.is_changed) = (None, 0.0, false);
            })?,
            Action::Fault { damper, fault } => {
                let names = || FAULTS.iter().map(|fault| fault.id);
                let found = FaultKind::find(fault);
                let found = found.ok_or_else(|| UnknownName::new("fault", fault, names()))?;
                let numbers = found.changes(&self.dampers[self.damper(damper)?].as_new);
                self.change_as_new(damper, &numbers, |desk| {
                    (desk.fault, desk.wear) = (Some(found.id), 0.0)
                })?
            }
            Action::Speed { speed_km_h } => {
                within("speed_km_h", *speed_km_h, SPEED_KM_H)?;
                self.speed_km_h = *speed_km_h;
                Change::Speed(speed_km_h / 3.6)
            }
            Action::Friction { factor } => {
                within("friction factor", *factor, FRICTION_FACTOR)?;
                self.friction_factor = *factor;
                Change::Friction(*factor)
            }
            Action::Defect { kind, size } => {
                let names = || DEFECTS.iter().map(|defect| defect.kind);
                let Some(known) = DEFECTS.iter().find(|known| known.kind == kind) else {
                    return Err(UnknownName::new("defect", kind, names()).into());
                };
                within("size", *size, [known.min, known.max])?;
                let start_m = place.distance_m + self.leading_m + AHEAD_M;
                let mut defects = self.defects.clone();
                defects.extend(defect(kind, *size, start_m));
                let change = self.track_with(&defects)?;
                self.defects = defects;
                change
            }
            Action::Gust {
                force_n,
                duration_s,
            } => {
                within("force_n", *force_n, [-GUST_N, GUST_N])?;
                within("duration_s", *duration_s, GUST_S)?;
                Change::Gust {
                    force_n: *force_n,
                    duration_s: *duration_s,
                }
            }
        };
        self.actions.push((place.tick, action.clone()));
        Ok(change)
    }

    fn damper(&self, name: &str) -> Result<usize, ActionError> {
        let names = || self.dampers.iter().map(|damper| damper.name.as_str());
        let found = names().position(|known| known == name);
        Ok(found.ok_or_else(|| UnknownName::new("damper", name, names()))?)
    }

    /// Changes numbers of a damper as new.
    fn change_as_new(
        &mut self,
        name: &str,
        numbers: &[(&str, f64)],
        note: impl FnOnce(&mut DeskDamper),
    ) -> Result<Change, ActionError> {
        let index = self.damper(name)?;
        let checked = self.dampers[index].as_new.with(numbers)?;
        self.put(index, &checked, |damper| {
            damper.usual = damper.as_new.clone();
            note(damper);
        })
    }

    /// Builds a damper and puts it on the desk.
    fn put(
        &mut self,
        index: usize,
        parameters: &DamperParameters,
        note: impl FnOnce(&mut DeskDamper),
    ) -> Result<Change, ActionError> {
        let change = self.built(index, parameters)?;
        let damper = &mut self.dampers[index];
        damper.now = KeyedParameters::new(&damper.name, parameters)?;
        damper.is_changed = true;
        note(damper);
        Ok(change)
    }

    /// Defects of the track, those of the case first.
    pub(crate) fn defects(&self) -> &[Defect] {
        &self.defects
    }

    /// Puts the desk where these actions and defects left it.
    pub(crate) fn replay(
        &mut self,
        actions: &[(u64, Action)],
        defects: &[Defect],
    ) -> Result<(), ActionError> {
        for (tick, action) in actions {
            self.act(
                action,
                Place {
                    tick: *tick,
                    distance_m: 0.0,
                },
            )?;
        }
        self.defects = defects.to_vec();
        Ok(())
    }

    /// Builds a damper.
    fn built(&self, index: usize, parameters: &DamperParameters) -> Result<Change, ActionError> {
        let built = self.vehicle.build_damper(index, parameters);
        Ok(Change::Damper {
            index,
            built: Box::new(built.map_err(VehicleRunError::from)?),
        })
    }

    /// Builds the track with these defects in place of its own.
    fn track_with(&self, defects: &[Defect]) -> Result<Change, ActionError> {
        let mut track = self.case.track.clone();
        track.defects = defects.to_vec();
        let built = track.build().map_err(VehicleRunError::from)?;
        Ok(Change::Track(Arc::new(built)))
    }

    /// Builds every damper that is not as new, with some of its parameters.
    fn changed_dampers(
        &self,
        of: impl Fn(&DeskDamper) -> &KeyedParameters,
    ) -> Result<Vec<Change>, ActionError> {
        let dampers = self.dampers.iter().enumerate();
        dampers
            .filter(|(_, damper)| damper.is_changed)
            .map(|(index, damper)| self.built(index, &*of(damper).with(&[])?))
            .collect()
    }

    /// Returns the changes that make every damper of the desk as new.
    pub(crate) fn dampers_as_new(&self) -> Result<Vec<Change>, ActionError> {
        self.changed_dampers(|damper| &damper.as_new)
    }

    /// Returns the changes that bring a vehicle as new to the state of the desk, without speed, friction and gusts.
    pub(crate) fn changes(&self) -> Result<Vec<Change>, ActionError> {
        let mut changes = self.changed_dampers(|damper| &damper.now)?;
        changes.push(self.track_with(&self.defects)?);
        Ok(changes)
    }
}
