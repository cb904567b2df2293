//! Validity limits of the model: wheel loads far above those at standstill, wheels that lift off the rail, and runs
//! that outlast the irregularities of their track.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::Standstill;

use super::signals::SIDES;
use super::warning::{WARN_EVEN_S, WARN_LIFT_S, WARN_LOAD_RATIO};
use super::{VehicleTick, Warning, end, start};
use dashpot_files::case::Case;
use dashpot_files::nearest_nanosecond;

/// Wheel load, as a multiple of the load at standstill, that ends the run: the mean pressure of the elastic contact
/// then exceeds 3 GPa, the hardness of rail steel.
pub const END_LOAD_RATIO: f64 = 50.0;

/// Monitors every wheel tick by tick, without allocating in a tick.
#[derive(Debug, Clone)]
pub struct ValidityWatch {
    step_s: f64,
    ticks: u64,
    /// Minimum number of ticks that is longer than [`WARN_LIFT_S`].
    long_ticks: u64,
    start: Option<Warning>,
    /// End of the track's irregularities, m; infinite if there are none.
    irregular_to_m: f64,
    /// Number of ticks beyond it.
    even_ticks: u64,
    wheels: Vec<Wheel>,
}

#[derive(Debug, Clone)]
struct Wheel {
    wheelset: String,
    side: usize,
    /// Position of the wheelset ahead of the vehicle's middle, m.
    x_m: f64,
    /// `None` if the vehicle has no equilibrium at standstill.
    load_static_n: Option<f64>,
    max_load: Moment,
    beyond_ticks: u64,
    /// Current lift; zero ticks if the wheel is loaded.
    current: Lift,
    longest: Lift,
    long_lifts: u64,
}

/// Consecutive ticks in which a wheel carries no load.
#[derive(Debug, Clone, Copy, Default)]
struct Lift {
    ticks: u64,
    start: Moment,
}

/// Load of a wheel within a tick, the tick's number (from 1), and the wheel's position at the end of the tick.
#[derive(Debug, Clone, Copy, Default)]
struct Moment {
    load_n: f64,
    tick: u64,
    distance_m: f64,
}

impl ValidityWatch {
    /// Starts monitoring the vehicle of a case on its track.
    pub fn new(case: &Case, track: &Track) -> Self {
        let standstill = Standstill::new(&case.vehicle).ok();
        let axle_load_n = |index: usize| {
            let standstill = standstill.as_ref()?;
            standstill.axle_loads_n().get(index).copied()
        };
        let wheelsets = case.vehicle.wheelsets.iter().enumerate();
        let wheels = wheelsets.flat_map(|(index, wheelset)| {
            let load_static_n = axle_load_n(index).map(|load_n| 0.5 * load_n);
            [0, 1].map(|side| Wheel {
                wheelset: wheelset.name.clone(),
                side,
                x_m: wheelset.x_m,
                load_static_n,
                max_load: Moment::default(),
                beyond_ticks: 0,
                current: Lift::default(),
                longest: Lift::default(),
                long_lifts: 0,
            })
        });
        Self {
            step_s: case.step_s,
            ticks: 0,
            // One tick more than WARN_LIFT_S contains; the factor guards against rounding below a whole number.
            long_ticks: (WARN_LIFT_S / case.step_s * (1.0 + 1e-9)) as u64 + 1,
            start: start::warning(case, track),
            irregular_to_m: end::irregular_to_m(track),
            even_ticks: 0,
            wheels: wheels.collect(),
        }
    }

    /// Adds a tick.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        let extremes = tick.extremes().iter();
        let loads_n = extremes.flat_map(|extremes| extremes.greatest_loads_n);
        self.ticks += 1;
        self.even_ticks += u64::from(tick.distance_m() > self.irregular_to_m);
        for (wheel, load_n) in self.wheels.iter_mut().zip(loads_n) {
            wheel.add(Moment {
                load_n,
                tick: self.ticks,
                distance_m: tick.distance_m() + wheel.x_m,
            });
            wheel.long_lifts += u64::from(wheel.current.ticks == self.long_ticks);
        }
    }

    /// Longest duration for which a wheel carried no load, s.
    pub fn longest_lift_s(&self) -> f64 {
        let longest = self.wheels.iter().map(|wheel| wheel.longest.ticks).max();
        longest.unwrap_or(0) as f64 * self.step_s
    }

    /// Maximum ratio of a wheel's load to its load at standstill; `None` if the vehicle has no equilibrium at
    /// standstill.
    pub fn greatest_load_ratio(&self) -> Option<f64> {
        let ratio = |wheel: &Wheel| Some(wheel.max_load.load_n / wheel.load_static_n?);
        self.wheels.iter().filter_map(ratio).reduce(f64::max)
    }

    fn end_warning(&self) -> Option<Warning> {
        let even_s = self.even_ticks as f64 * self.step_s;
        (even_s > WARN_EVEN_S).then_some(Warning::IrregularitiesEnd {
            end_m: self.irregular_to_m,
            even_s,
            duration_s: self.ticks as f64 * self.step_s,
        })
    }

    /// Returns the warnings: of the start and the end of the irregularities, then by wheel, loads before lifts.
    pub fn warnings(&self) -> Vec<Warning> {
        let wheels = || self.wheels.iter();
        let loads = wheels().filter_map(|wheel| self.load_warning(wheel));
        let lifts = wheels().filter(|wheel| wheel.long_lifts > 0);
        let lifts = lifts.map(|wheel| self.lift_warning(wheel));
        self.start
            .iter()
            .cloned()
            .chain(self.end_warning())
            .chain(loads)
            .chain(lifts)
            .collect()
    }

    /// True if there is a warning; costs nothing in every tick.
    pub fn has_warnings(&self) -> bool {
        let is_outside = |wheel: &Wheel| {
            wheel.long_lifts > 0 || (wheel.beyond_ticks > 0 && wheel.load_static_n.is_some())
        };
        self.start.is_some() || self.end_warning().is_some() || self.wheels.iter().any(is_outside)
    }

    /// Time at the end of a tick, s.
    fn time_s(&self, tick: u64) -> f64 {
        nearest_nanosecond(tick as f64 * self.step_s)
    }

    fn load_warning(&self, wheel: &Wheel) -> Option<Warning> {
        let load_static_n = wheel.load_static_n?;
        (wheel.beyond_ticks > 0).then(|| Warning::WheelLoad {
            wheelset: wheel.wheelset.clone(),
            side: SIDES[wheel.side],
            load_n: wheel.max_load.load_n,
            load_static_n,
            time_s: self.time_s(wheel.max_load.tick),
            distance_m: wheel.max_load.distance_m,
            ticks: wheel.beyond_ticks,
        })
    }

    fn lift_warning(&self, wheel: &Wheel) -> Warning {
        let Lift { ticks, start } = wheel.longest;
        Warning::WheelLift {
            wheelset: wheel.wheelset.clone(),
            side: SIDES[wheel.side],
            duration_s: self.time_s(ticks),
            time_s: self.time_s(start.tick - 1),
            distance_m: start.distance_m,
            times: wheel.long_lifts,
        }
    }
}

impl Wheel {
    fn add(&mut self, moment: Moment) {
        if moment.load_n > self.max_load.load_n {
            self.max_load = moment;
        }
        let is_beyond = |static_n: f64| moment.load_n > WARN_LOAD_RATIO * static_n;
        self.beyond_ticks += u64::from(self.load_static_n.is_some_and(is_beyond));
        if moment.load_n > 0.0 {
            self.current.ticks = 0;
            return;
        }
        if self.current.ticks == 0 {
            self.current.start = moment;
        }
        self.current.ticks += 1;
        if self.current.ticks > self.longest.ticks {
            self.longest = self.current;
        }
    }
}
