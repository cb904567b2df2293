//! A run of a case, tick by tick.

use std::fmt;
use std::sync::Arc;

use dashpot_core::Damper;
use dashpot_rail::contact::{Status, WheelsetContact};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleError, VehicleState};

use super::hunting::push_aside;
use super::overturning::Overturned;
use super::signals::SIDES;
use super::validity::END_LOAD_RATIO;
use super::{VehicleRunError, contact};
use dashpot_files::case::{Case, Fault};

/// A vehicle on its track, before or between ticks.
#[derive(Debug, Clone)]
pub struct Run {
    vehicle: Vehicle<KalkerBook>,
    track: Arc<Track>,
    state: VehicleState,
    faults: Vec<BuiltFault>,
    next_fault: usize,
    ticks: u64,
}

/// A fault whose damper is built before the run, so that no tick has to build one.
#[derive(Debug, Clone)]
struct BuiltFault {
    time_s: f64,
    damper: usize,
    built: Damper<f64>,
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case", tag = "reason")]
pub enum Ending {
    /// After its time.
    Completed,
    /// A wheel's flange has run over the rail's top, or its tread off it.
    Derailed {
        /// Wheelset.
        wheelset: String,
        /// When, s.
        time_s: f64,
        /// Where the middle of the vehicle was, m.
        distance_m: f64,
    },
    /// A wheelset moved beyond what the tables of the contact know.
    OutsideTables {
        /// Wheelset.
        wheelset: String,
        /// When, s.
        time_s: f64,
        /// Where the middle of the vehicle was, m.
        distance_m: f64,
    },
    /// The vehicle tipped over to one side: the wheels of the other side have left the rail and its wheelsets are tilted.
    Overturned {
        /// The side that it fell to, `left` or `right`.
        side: &'static str,
        /// Wheels of the other side without load.
        unloaded_wheels: usize,
        /// All wheels of that side.
        wheels: usize,
        /// The most tilted wheelset.
        wheelset: String,
        /// Its roll, the right side down positive, rad.
        roll_rad: f64,
        /// When, s.
        time_s: f64,
        /// Where the middle of the vehicle was, m.
        distance_m: f64,
    },
    /// A wheel was loaded far beyond what the contact of this model means.
    BeyondModel {
        /// Wheelset.
        wheelset: String,
        /// Its wheel, `left` or `right`.
        side: &'static str,
        /// Load, N.
        load_n: f64,
        /// Load of this wheel at standstill, N.
        load_static_n: f64,
        /// When, s.
        time_s: f64,
        /// Where the middle of the vehicle was, m.
        distance_m: f64,
    },
    /// Displacements grew beyond all bounds.
    Diverged {
        /// When, s.
        time_s: f64,
        /// Where, m.
        distance_m: f64,
    },
    /// A damper outside gave no force any more.
    OutsideLost {
        /// The link that it is behind, and why.
        message: String,
        /// When, s.
        time_s: f64,
        /// Where, m.
        distance_m: f64,
    },
    /// The user did not want to wait.
    Interrupted {
        /// When, s.
        time_s: f64,
        /// Where, m.
        distance_m: f64,
    },
}

impl Ending {
    /// True if the run has indices. A run that derailed, overturned, diverged, left the tables or went beyond the model has none.
    pub fn has_indices(&self) -> bool {
        matches!(
            self,
            Self::Completed | Self::Interrupted { .. } | Self::OutsideLost { .. }
        )
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Completed => write!(f, "completed"),
            Self::Derailed {
                wheelset,
                time_s,
                distance_m,
            } => write!(
                f,
                "derailed: {wheelset} at {time_s:.3} s, {distance_m:.1} m along the track"
            ),
            Self::OutsideTables {
                wheelset,
                time_s,
                distance_m,
            } => write!(
                f,
                "{wheelset} left the tables of the contact at {time_s:.3} s, {distance_m:.1} m along the track"
            ),
            Self::Overturned {
                side,
                unloaded_wheels,
                wheels,
                wheelset,
                roll_rad,
                time_s,
                distance_m,
            } => write!(
                f,
                "overturned to the {side} at {time_s:.3} s, {distance_m:.1} m along the track: {unloaded_wheels} of {wheels} wheels of the \
                 other side carry no load, {wheelset} is tilted by {:.0} mrad",
                1e3 * roll_rad.abs()
            ),
            Self::BeyondModel {
                wheelset,
                side,
                load_n,
                load_static_n,
                time_s,
                distance_m,
            } => write!(
                f,
                "beyond the model at {time_s:.3} s, {distance_m:.1} m along the track: {wheelset}, {side} wheel: load {:.0} kN, {:.0} times \
                 that at standstill; allowed: {END_LOAD_RATIO:.0} times",
                1e-3 * load_n,
                load_n / load_static_n
            ),
            Self::Diverged { time_s, distance_m } => write!(
                f,
                "diverged at {time_s:.3} s, {distance_m:.1} m along the track"
            ),
            Self::OutsideLost {
                message,
                time_s,
                distance_m,
            } => write!(
                f,
                "a damper outside was lost at {time_s:.3} s, {distance_m:.1} m along the track: {message}"
            ),
            Self::Interrupted { time_s, distance_m } => write!(
                f,
                "interrupted at {time_s:.3} s, {distance_m:.1} m along the track"
            ),
        }
    }
}

impl Run {
    /// The vehicle of `case` at its start.
    ///
    /// # Errors
    /// A vehicle, track or contact that is refused.
    pub fn new(case: &Case) -> Result<Self, VehicleRunError> {
        let contact =
            contact::tabulated(&case.vehicle, case.friction, case.normal_damping_s_per_m)?;
        Self::on(case, contact, Arc::new(case.track.build()?))
    }

    /// As [`Self::new`], with the contact of [`contact::tabulated`] and the built track, which runs may share.
    ///
    /// # Errors
    /// A vehicle that is refused.
    pub fn on(
        case: &Case,
        contact: Arc<WheelsetContact<KalkerBook>>,
        track: Arc<Track>,
    ) -> Result<Self, VehicleRunError> {
        let vehicle = Vehicle::on_rails(&case.vehicle, contact, case.step_s, case.rails)?;
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
            vehicle,
            track,
            state,
            faults,
            next_fault: 0,
        })
    }

    /// Ticks of the whole run.
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

    /// Where it is.
    pub fn state(&self) -> &VehicleState {
        &self.state
    }

    /// Where it is, for a force from outside.
    pub fn state_mut(&mut self) -> &mut VehicleState {
        &mut self.state
    }

    /// Goes on from a state that this run has had; `start` is the run before its first tick.
    ///
    /// # Errors
    /// A state of another vehicle; then nothing changes.
    pub fn restore(&mut self, start: &Self, state: VehicleState) -> Result<(), VehicleRunError> {
        if !start.vehicle.can_step(&state) {
            return Err(VehicleError::OtherVehicle.into());
        }
        // The next tick makes the faults until then again, which leaves a damper that has had one as it is.
        self.clone_from(start);
        self.state = state;
        Ok(())
    }

    /// True when every tick has been taken.
    pub fn is_over(&self) -> bool {
        self.state.ticks() >= self.ticks
    }

    /// One tick, with the faults that are due; how the run ended, if it did. Allocates only when it ends.
    ///
    /// # Errors
    /// None that is known: the dampers of faults are built by [`Self::new`].
    pub fn step(&mut self) -> Result<Option<Ending>, VehicleRunError> {
        if self.is_over() {
            return Ok(Some(Ending::Completed));
        }
        while let Some(fault) = self.faults.get(self.next_fault) {
            if fault.time_s > self.time_s() + 0.5 * self.vehicle.step_s() {
                break;
            }
            self.vehicle.replace_damper(fault.damper, &fault.built)?;
            self.next_fault += 1;
        }
        self.vehicle.step(&mut self.state, &self.track);
        Ok(self.ending())
    }

    /// The run ends here because the user wants it to.
    pub fn interrupted(&self) -> Ending {
        Ending::Interrupted {
            time_s: self.time_s(),
            distance_m: self.state.distance_m(),
        }
    }

    /// The run ends here because a damper outside gives no force.
    pub fn outside_lost(&self, message: String) -> Ending {
        Ending::OutsideLost {
            message,
            time_s: self.time_s(),
            distance_m: self.state.distance_m(),
        }
    }

    /// The run ends here because displacements grow beyond all bounds.
    pub(super) fn diverged(&self) -> Ending {
        Ending::Diverged {
            time_s: self.time_s(),
            distance_m: self.state.distance_m(),
        }
    }

    /// How the state ends the run, if it does.
    pub(super) fn ending(&self) -> Option<Ending> {
        let (time_s, distance_m) = (self.time_s(), self.state.distance_m());
        if self.state.is_diverged() {
            return Some(self.diverged());
        }
        let worst = self
            .state
            .contacts()
            .iter()
            .enumerate()
            .max_by_key(|(_, contact)| contact.status);
        let (number, contact) = worst?;
        if contact.status < Status::PastTip {
            return self.beyond_model();
        }
        let wheelset = self.wheelset_name(number);
        if let Some(found) = Overturned::of(&self.state) {
            return Some(Ending::Overturned {
                side: SIDES[found.side],
                unloaded_wheels: found.unloaded_wheels,
                wheels: self.vehicle.wheelsets(),
                wheelset: self.wheelset_name(found.wheelset),
                roll_rad: found.roll_rad,
                time_s,
                distance_m,
            });
        }
        if contact.status == Status::PastTip {
            return Some(Ending::Derailed {
                wheelset,
                time_s,
                distance_m,
            });
        }
        // A load far too high presses a wheel deeper into the rail than the tables go.
        self.beyond_model().or(Some(Ending::OutsideTables {
            wheelset,
            time_s,
            distance_m,
        }))
    }

    /// The run ends here because a wheel's load is beyond the model, if one is.
    fn beyond_model(&self) -> Option<Ending> {
        let loads_n = self.state.greatest_wheel_loads_n().iter();
        let mut wheels = loads_n.zip(self.vehicle.axle_loads_n()).enumerate();
        wheels.find_map(|(number, (loads_n, axle_load_n))| {
            let load_static_n = 0.5 * axle_load_n;
            let side = (0..2).find(|side| loads_n[*side] > END_LOAD_RATIO * load_static_n)?;
            Some(Ending::BeyondModel {
                wheelset: self.wheelset_name(number),
                side: SIDES[side],
                load_n: loads_n[side],
                load_static_n,
                time_s: self.time_s(),
                distance_m: self.state.distance_m(),
            })
        })
    }

    fn wheelset_name(&self, number: usize) -> String {
        let first = self.vehicle.names().len() - self.vehicle.wheelsets();
        self.vehicle.names()[first + number].clone()
    }
}
