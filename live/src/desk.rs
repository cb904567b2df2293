//! The operator's side: checks actions and prepares what the running vehicle takes over between two ticks.

use std::sync::Arc;

use dashpot_core::{CheckedParameters, Damper, DamperParameters};
use dashpot_files::case::Case;
use dashpot_files::damper::DamperError;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::{Defect, Track};
use dashpot_rail::vehicle::{FRICTION_FACTOR, Law, Vehicle};
use dashpot_vehicle_run::{Run, VehicleRunError};

use crate::damper_desk::DamperDesk;
use crate::defect::{AHEAD_M, DEFECTS, defect};
use crate::error::within;
use crate::outline::wheelbase;
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

/// Checks and prepares actions; knows the parameters of everything that they may change.
#[derive(Debug, Clone)]
pub struct Desk {
    case: Case,
    vehicle: Vehicle<KalkerBook>,
    dampers: Vec<DamperDesk>,
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
        let dampers = dampers.map(|(name, parameters)| DamperDesk::new(name, parameters));
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

    /// The dampers.
    pub fn dampers(&self) -> &[DamperDesk] {
        &self.dampers
    }

    /// Checks an action and prepares its change.
    ///
    /// # Errors
    /// Unknown names, or values that are not allowed. On an error, nothing changes.
    pub fn act(&mut self, action: &Action, place: Place) -> Result<Change, ActionError> {
        let change = match action {
            Action::Damper { damper, .. }
            | Action::Preset { damper, .. }
            | Action::AsNew { damper }
            | Action::Fault { damper, .. } => {
                let index = self.damper(damper)?;
                let after = self.dampers[index].after(action)?;
                let change = self.built(index, &*after.parameters()?)?;
                self.dampers[index] = after;
                change
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
        let names = || self.dampers.iter().map(DamperDesk::name);
        let found = names().position(|known| known == name);
        Ok(found.ok_or_else(|| UnknownName::new("damper", name, names()))?)
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
        parameters: impl Fn(&DamperDesk) -> Result<CheckedParameters, DamperError>,
    ) -> Result<Vec<Change>, ActionError> {
        let dampers = self.dampers.iter().enumerate();
        dampers
            .filter(|(_, damper)| damper.is_changed())
            .map(|(index, damper)| self.built(index, &*parameters(damper)?))
            .collect()
    }

    /// Returns the changes that make every damper of the desk as new.
    ///
    /// # Errors
    /// None are known: every damper was built before.
    pub fn dampers_as_new(&self) -> Result<Vec<Change>, ActionError> {
        self.changed_dampers(DamperDesk::parameters_as_new)
    }

    /// Returns the changes that bring a vehicle as new to the state of the desk, without speed, friction and gusts.
    ///
    /// # Errors
    /// None are known: every damper and the track were built before.
    pub fn changes(&self) -> Result<Vec<Change>, ActionError> {
        let mut changes = self.changed_dampers(DamperDesk::parameters)?;
        changes.push(self.track_with(&self.defects)?);
        Ok(changes)
    }
}
