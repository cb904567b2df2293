//! Where a run leaves what the model means: wheel loads far above those at standstill, and wheels that leave the rail.

use std::fmt;

use dashpot_rail::vehicle::Standstill;
use serde::Serialize;

use super::VehicleTick;
use super::signals::SIDES;
use dashpot_files::case::Case;
use dashpot_files::nearest_nanosecond;

/// A wheel load over so many times that at standstill is reported: contact and track of the model are elastic, and its normal damping is
/// measured at small impacts.
pub const WARN_LOAD_RATIO: f64 = 10.0;

/// A wheel load over so many times that at standstill ends the run: the mean pressure of the elastic contact passes 3 GPa there, the hardness
/// of rail steel.
pub const END_LOAD_RATIO: f64 = 50.0;

/// A wheel without load for longer is reported, s.
pub const WARN_LIFT_S: f64 = 0.05;

/// Something that the run computed but the model does not mean.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Warning {
    /// A wheel carried more than [`WARN_LOAD_RATIO`] times its load at standstill.
    WheelLoad {
        /// Wheelset.
        wheelset: String,
        /// Its wheel, `left` or `right`.
        side: &'static str,
        /// Greatest load, N.
        load_n: f64,
        /// Load at standstill, N.
        load_static_n: f64,
        /// When the load was greatest, s.
        time_s: f64,
        /// Where the wheelset was then, m along the track.
        distance_m: f64,
        /// Ticks with a load beyond the limit.
        ticks: u64,
    },
    /// A wheel carried no load for more than [`WARN_LIFT_S`].
    WheelLift {
        /// Wheelset.
        wheelset: String,
        /// Its wheel, `left` or `right`.
        side: &'static str,
        /// Longest time without load, s.
        duration_s: f64,
        /// When it began, s.
        time_s: f64,
        /// Where the wheelset was then, m along the track.
        distance_m: f64,
        /// How often the wheel was without load for more than the limit.
        times: u64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WheelLoad {
                wheelset,
                side,
                load_n,
                load_static_n,
                time_s,
                distance_m,
                ticks,
            } => write!(
                f,
                "{wheelset}, {side} wheel: load up to {:.0} kN, {:.1} times that at standstill, at {time_s:.3} s, {distance_m:.1} m along \
                 the track, and over {WARN_LOAD_RATIO:.0} times in {}: beyond what the contact of this model means",
                1e-3 * load_n,
                load_n / load_static_n,
                counted(*ticks, "tick")
            ),
            Self::WheelLift {
                wheelset,
                side,
                duration_s,
                time_s,
                distance_m,
                times,
            } => write!(
                f,
                "{wheelset}, {side} wheel: without load for {duration_s:.3} s from {time_s:.3} s on, {distance_m:.1} m along the track, \
                 and for more than {WARN_LIFT_S} s {}: a vehicle near derailment",
                counted(*times, "time")
            ),
        }
    }
}

fn counted(count: u64, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// Watches every wheel, tick by tick; allocates nothing in a tick.
#[derive(Debug, Clone)]
pub struct ValidityWatch {
    step_s: f64,
    ticks: u64,
    /// The fewest ticks that are longer than [`WARN_LIFT_S`].
    long_ticks: u64,
    wheels: Vec<Wheel>,
}

#[derive(Debug, Clone)]
struct Wheel {
    wheelset: String,
    side: usize,
    /// Of the wheelset before the vehicle's middle, m.
    x_m: f64,
    /// `None` where the vehicle has no standstill.
    load_static_n: Option<f64>,
    greatest: Moment,
    beyond_ticks: u64,
    /// The lift that goes on, if one does, and the longest: ticks, and the moment of the first.
    now: (u64, Moment),
    longest: (u64, Moment),
    long_lifts: u64,
}

/// Load of a wheel during a tick, the first being 1, and its place at the end of it.
#[derive(Debug, Clone, Copy, Default)]
struct Moment {
    load_n: f64,
    tick: u64,
    distance_m: f64,
}

impl ValidityWatch {
    /// Of the vehicle of a case.
    pub fn new(case: &Case) -> Self {
        let standstill = Standstill::new(&case.vehicle).ok();
        let axle_load_n = |number: usize| {
            let standstill = standstill.as_ref()?;
            standstill.axle_loads_n().get(number).copied()
        };
        let wheelsets = case.vehicle.wheelsets.iter().enumerate();
        let wheels = wheelsets.flat_map(|(number, wheelset)| {
            let load_static_n = axle_load_n(number).map(|load_n| 0.5 * load_n);
            [0, 1].map(|side| Wheel {
                wheelset: wheelset.name.clone(),
                side,
                x_m: wheelset.x_m,
                load_static_n,
                greatest: Moment::default(),
                beyond_ticks: 0,
                now: (0, Moment::default()),
                longest: (0, Moment::default()),
                long_lifts: 0,
            })
        });
        Self {
            step_s: case.step_s,
            ticks: 0,
            // A tick more than the time has, whose whole number is not to be missed by a rounding.
            long_ticks: (WARN_LIFT_S / case.step_s * (1.0 + 1e-9)) as u64 + 1,
            wheels: wheels.collect(),
        }
    }

    /// Adds the vehicle after a tick.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        let loads_n = tick.greatest_wheel_loads_n().as_flattened();
        self.ticks += 1;
        for (wheel, load_n) in self.wheels.iter_mut().zip(loads_n) {
            wheel.add(Moment {
                load_n: *load_n,
                tick: self.ticks,
                distance_m: tick.distance_m() + wheel.x_m,
            });
            wheel.long_lifts += u64::from(wheel.now.0 == self.long_ticks);
        }
    }

    /// Longest time for which a wheel carried no load, s.
    pub fn longest_lift_s(&self) -> f64 {
        let longest = self.wheels.iter().map(|wheel| wheel.longest.0).max();
        longest.unwrap_or(0) as f64 * self.step_s
    }

    /// Greatest load of a wheel over its load at standstill; `None` where the vehicle has no standstill.
    pub fn greatest_load_ratio(&self) -> Option<f64> {
        let ratio = |wheel: &Wheel| Some(wheel.greatest.load_n / wheel.load_static_n?);
        self.wheels.iter().filter_map(ratio).reduce(f64::max)
    }

    /// What is to be reported, wheel by wheel, loads first.
    pub fn warnings(&self) -> Vec<Warning> {
        let wheels = || self.wheels.iter();
        let loads = wheels().filter_map(|wheel| self.load_warning(wheel));
        let lifts = wheels().filter(|wheel| wheel.long_lifts > 0);
        let lifts = lifts.map(|wheel| self.lift_warning(wheel));
        loads.chain(lifts).collect()
    }

    /// The end of a tick, s.
    fn time_s(&self, tick: u64) -> f64 {
        nearest_nanosecond(tick as f64 * self.step_s)
    }

    fn load_warning(&self, wheel: &Wheel) -> Option<Warning> {
        let load_static_n = wheel.load_static_n?;
        (wheel.beyond_ticks > 0).then(|| Warning::WheelLoad {
            wheelset: wheel.wheelset.clone(),
            side: SIDES[wheel.side],
            load_n: wheel.greatest.load_n,
            load_static_n,
            time_s: self.time_s(wheel.greatest.tick),
            distance_m: wheel.greatest.distance_m,
            ticks: wheel.beyond_ticks,
        })
    }

    fn lift_warning(&self, wheel: &Wheel) -> Warning {
        let (ticks, began) = wheel.longest;
        Warning::WheelLift {
            wheelset: wheel.wheelset.clone(),
            side: SIDES[wheel.side],
            duration_s: self.time_s(ticks),
            time_s: self.time_s(began.tick - 1),
            distance_m: began.distance_m,
            times: wheel.long_lifts,
        }
    }
}

impl Wheel {
    fn add(&mut self, moment: Moment) {
        if moment.load_n > self.greatest.load_n {
            self.greatest = moment;
        }
        let is_beyond = |static_n: f64| moment.load_n > WARN_LOAD_RATIO * static_n;
        self.beyond_ticks += u64::from(self.load_static_n.is_some_and(is_beyond));
        if moment.load_n > 0.0 {
            self.now.0 = 0;
            return;
        }
        if self.now.0 == 0 {
            self.now.1 = moment;
        }
        self.now.0 += 1;
        if self.now.0 > self.longest.0 {
            self.longest = self.now;
        }
    }
}
