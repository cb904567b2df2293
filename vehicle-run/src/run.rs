//! Run of a case, tick by tick.

use std::sync::Arc;

use dashpot_core::{Damper, DamperParameters};
use dashpot_rail::contact::Status;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{COORDINATES, Vehicle, VehicleError, VehicleState};

use super::VehicleRunError;
use super::contact::{Contact, ContactSetup};
use super::ending::{Ending, Place};
use super::hunting::push_aside;
use super::influences::Influences;
use super::outside_loss::OutsideLoss;
use super::overturning::Overturned;
use super::signals::SIDES;
use super::validity::END_LOAD_RATIO;
use dashpot_files::case::{Case, Fault};
use dashpot_files::did_you_mean;

/// Run of a vehicle on its track, before or between ticks.
#[derive(Debug, Clone)]
pub struct Run {
    vehicle: Vehicle<KalkerBook>,
    contacts: Vec<Contact>,
    track: Arc<Track>,
    state: VehicleState,
    faults: Vec<BuiltFault>,
    next_fault: usize,
    influences: Influences,
    ticks: u64,
}

/// Fault with its damper built in advance, so that no tick has to build one.
#[derive(Debug, Clone)]
struct BuiltFault {
    time_s: f64,
    damper: usize,
    built: Damper<f64>,
}

impl Run {
    /// Places the vehicle of `case` at its start; computes and caches the contact tables if necessary.
    ///
    /// # Errors
    /// Invalid vehicle, track or contact.
    pub fn new(case: &Case) -> Result<Self, VehicleRunError> {
        let contacts = ContactSetup::of_case(case)?.tabulated()?;
        Self::on(case, contacts, Arc::new(case.track.build()?))
    }

    /// Places the vehicle of `case` at its start, with the contact of each wheelset from [`ContactSetup`] and a built
    /// track, which several runs can share.
    ///
    /// # Errors
    /// Invalid vehicle.
    pub fn on(
        case: &Case,
        contacts: Vec<Contact>,
        track: Arc<Track>,
    ) -> Result<Self, VehicleRunError> {
        let vehicle =
            Vehicle::with_contacts(&case.vehicle, contacts.clone(), case.step_s, case.rails)?;
        let mut state = vehicle.at_rest(&track, case.start_m, case.speed_m_per_s)?;
        if case.push_m != 0.0 {
            push_aside(&vehicle, &mut state, &track, case.push_m)?;
        }
        let build = |fault: &Fault| {
            let damper = vehicle
                .damper_names()
                .position(|name| name == fault.damper)?;
            let built = vehicle.build_damper(damper, &fault.parameters);
            Some(built.map(|built| BuiltFault {
                time_s: fault.time_s,
                damper,
                built,
            }))
        };
        let faults = case.faults.iter().filter_map(build);
        let faults = faults.collect::<Result<_, _>>()?;
        Ok(Self {
            ticks: (case.duration_s / case.step_s).round() as u64,
            influences: Influences::new(case, &vehicle),
            vehicle,
            contacts,
            track,
            state,
            faults,
            next_fault: 0,
        })
    }

    /// Number of ticks of the whole run.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Time since the start, s.
    pub fn time_s(&self) -> f64 {
        self.state.ticks() as f64 * self.vehicle.step_s()
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle<KalkerBook> {
        &self.vehicle
    }

    /// The contact of each wheelset.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// The track.
    pub fn track(&self) -> &Arc<Track> {
        &self.track
    }

    /// Current state of the vehicle.
    pub fn state(&self) -> &VehicleState {
        &self.state
    }

    /// Current state of the vehicle, for setting the force of an external damper, speed, friction or applied forces.
    pub fn state_mut(&mut self) -> &mut VehicleState {
        &mut self.state
    }

    /// Resumes from an earlier state of this run; `start` is the run before its first tick.
    ///
    /// # Errors
    /// State of another vehicle. On this error, the run is unchanged.
    pub fn restore(&mut self, start: &Self, state: VehicleState) -> Result<(), VehicleRunError> {
        if !start.vehicle.can_step(&state) {
            return Err(VehicleError::OtherVehicle.into());
        }
        self.clone_from(start);
        self.state = state;
        // Replacing a damper by the one that it already has changes nothing.
        self.apply_faults(self.time_s() - self.vehicle.step_s())
    }

    /// Replaces a damper from the next tick on; its force stays continuous.
    ///
    /// # Errors
    /// No damper of this name, or parameters that cannot be built for the step of the case.
    pub fn replace_damper(
        &mut self,
        name: &str,
        parameters: &DamperParameters,
    ) -> Result<(), VehicleRunError> {
        let index = self.vehicle.damper_names().position(|other| other == name);
        match index {
            Some(index) => Ok(self.vehicle.set_damper(index, parameters)?),
            None => Err(VehicleRunError::NoDamper {
                name: name.to_owned(),
                near: did_you_mean(name, self.vehicle.damper_names()),
            }),
        }
    }

    /// Replaces a damper by a built one from the next tick on; its force stays continuous. Does not allocate.
    ///
    /// # Errors
    /// No damper with this index.
    pub fn put_damper(&mut self, index: usize, built: &Damper<f64>) -> Result<(), VehicleRunError> {
        Ok(self.vehicle.replace_damper(index, built)?)
    }

    /// Replaces the track from the next tick on. Under the vehicle both tracks must be the same, or the wheels jump.
    pub fn put_track(&mut self, track: &Arc<Track>) {
        self.track = Arc::clone(track);
    }

    /// True if all ticks have been simulated.
    pub fn is_over(&self) -> bool {
        self.state.ticks() >= self.ticks
    }

    /// Simulates one tick, after applying the faults and events that are due. Returns the ending if the run ended.
    /// Allocates only if it ended.
    ///
    /// # Errors
    /// No case is known in which this fails: [`Self::new`] has built the dampers of all faults, and a case checks its
    /// events.
    pub fn step(&mut self) -> Result<Option<Ending>, VehicleRunError> {
        if self.is_over() {
            return Ok(Some(Ending::Completed));
        }
        let time_s = self.time_s();
        self.apply_faults(time_s)?;
        self.influences.apply(time_s, &mut self.state)?;
        self.vehicle.step(&mut self.state, &self.track);
        Ok(self.ending())
    }

    /// Applies the faults that are due in ticks that begin until `time_s`.
    fn apply_faults(&mut self, time_s: f64) -> Result<(), VehicleRunError> {
        while let Some(fault) = self.faults.get(self.next_fault) {
            if fault.time_s > time_s + 0.5 * self.vehicle.step_s() {
                break;
            }
            self.vehicle.replace_damper(fault.damper, &fault.built)?;
            self.next_fault += 1;
        }
        Ok(())
    }

    /// Ending of a run that the user interrupts now.
    pub fn interrupted(&self) -> Ending {
        Ending::Interrupted {
            place: self.place(),
        }
    }

    /// Ending of a run in real time that stops after `tick`, whose work took `work_ns`; allowed: `limit_ns`.
    pub fn slow_tick(&self, tick: u64, work_ns: f64, limit_ns: u64) -> Ending {
        Ending::SlowTick {
            tick,
            work_ns,
            limit_ns,
            place: self.place(),
        }
    }

    /// Ending of a run whose external damper has stopped delivering forces.
    pub fn outside_lost(&self, loss: OutsideLoss) -> Ending {
        Ending::OutsideLost {
            loss,
            place: self.place(),
        }
    }

    /// Ending of a run whose damper is on a rig whose guard acted at `guarded_s` for these reasons.
    pub fn guard_ended(&self, damper: &str, reasons: Vec<String>, guarded_s: f64) -> Ending {
        Ending::GuardEnded {
            damper: damper.to_owned(),
            reasons,
            guarded_s,
            place: self.place(),
        }
    }

    fn place(&self) -> Place {
        Place {
            time_s: self.time_s(),
            distance_m: self.state.distance_m(),
        }
    }

    /// Ending of a run whose displacements diverge.
    pub(super) fn diverged(&self) -> Ending {
        let of_body = |(body, numbers): (usize, &[f64; 5])| {
            let coordinates = numbers
                .iter()
                .zip(COORDINATES)
                .map(move |(value, coordinate)| (body, coordinate, *value));
            coordinates.max_by(|a, b| size(a.2).total_cmp(&size(b.2)))
        };
        // NaN counts as greater than all numbers.
        fn size(value: f64) -> f64 {
            if value.is_nan() {
                f64::INFINITY
            } else {
                value.abs()
            }
        }
        let all = self
            .state
            .coordinates()
            .iter()
            .enumerate()
            .filter_map(of_body);
        let greatest = all.max_by(|a, b| size(a.2).total_cmp(&size(b.2)));
        let (body, coordinate, value) = greatest.unwrap_or((0, COORDINATES[0], f64::NAN));
        Ending::Diverged {
            body: self.vehicle.names()[body].clone(),
            coordinate: coordinate.name(),
            value: value.is_finite().then_some(value),
            place: self.place(),
        }
    }

    /// Returns the ending that the current state implies, if any.
    pub(super) fn ending(&self) -> Option<Ending> {
        if self.state.is_diverged() {
            return Some(self.diverged());
        }
        let worst = self
            .state
            .contacts()
            .iter()
            .enumerate()
            .max_by_key(|(_, contact)| contact.status);
        let (index, contact) = worst?;
        if contact.status < Status::PastTip {
            return self.beyond_model();
        }
        if let Some(found) = Overturned::detect(&self.state) {
            return Some(Ending::Overturned {
                side: SIDES[found.side],
                unloaded_wheels: found.unloaded_wheels,
                wheels: self.vehicle.wheelsets(),
                wheelset: self.wheelset_name(found.wheelset),
                roll_rad: found.roll_rad,
                place: self.place(),
            });
        }
        let side = usize::from(contact.wheels[1].status > contact.wheels[0].status);
        let first = self.state.coordinates().len() - self.vehicle.wheelsets();
        let [lateral_m, _, roll_rad, _, yaw_rad] = self.state.coordinates()[first + index];
        if contact.status == Status::PastTip {
            return Some(Ending::Climbed {
                wheelset: self.wheelset_name(index),
                side: SIDES[side],
                derailment: contact.derailment_coefficients()[side],
                load_n: contact.wheels[side].load_n(),
                lateral_m,
                yaw_rad,
                place: self.place(),
            });
        }
        // An excessive load presses the wheel deeper into the rail than the tables cover.
        self.beyond_model().or_else(|| {
            Some(Ending::OutsideTables {
                wheelset: self.wheelset_name(index),
                side: SIDES[side],
                lateral_m,
                roll_rad,
                yaw_rad,
                place: self.place(),
            })
        })
    }

    /// Returns the ending if a wheel load is beyond the model.
    fn beyond_model(&self) -> Option<Ending> {
        let extremes = self.state.extremes().iter();
        let loads_n = extremes.map(|extremes| extremes.greatest_loads_n);
        let mut wheels = loads_n.zip(self.vehicle.axle_loads_n()).enumerate();
        wheels.find_map(|(index, (loads_n, axle_load_n))| {
            let load_static_n = 0.5 * axle_load_n;
            let side = (0..2).find(|side| loads_n[*side] > END_LOAD_RATIO * load_static_n)?;
            Some(Ending::BeyondModel {
                wheelset: self.wheelset_name(index),
                side: SIDES[side],
                load_n: loads_n[side],
                load_static_n,
                place: self.place(),
            })
        })
    }

    fn wheelset_name(&self, index: usize) -> String {
        let first = self.vehicle.names().len() - self.vehicle.wheelsets();
        self.vehicle.names()[first + index].clone()
    }
}
