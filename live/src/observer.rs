//! Numbers of a frame: the last value of each signal, and its least and greatest since the frame before.

use dashpot_files::case::{Change, Event};
use dashpot_vehicle_run::recorded::all_signals;
use dashpot_vehicle_run::signals::Signal;
use dashpot_vehicle_run::{Indexer, Run, ValidityWatch, VehicleTick, filtered_names};

use crate::ActionError;
use crate::desk::{Desk, SPEED_KM_H};
use crate::health::{HealthLine, HealthWatch};

/// Bytes before the numbers of a frame.
const HEADER_BYTES: usize = 48;

/// Flags of a frame.
pub mod flags {
    /// The run has ended.
    pub const ENDED: u32 = 1;
    /// The model does not cover what happened.
    pub const OUTSIDE_VALIDITY: u32 = 2;
    /// The operator has stopped the run.
    pub const STOPPED: u32 = 4;
    /// The run is slower than wanted.
    pub const SLOW: u32 = 8;
}

/// Follows a run tick by tick, without allocating in a tick.
#[derive(Debug, Clone)]
pub struct Observer {
    signals: Vec<Signal>,
    names: Vec<String>,
    indexer: Indexer,
    validity: ValidityWatch,
    health: HealthWatch,
    last: Vec<f32>,
    least: Vec<f32>,
    greatest: Vec<f32>,
    ticks_in_frame: u32,
    time_s: f64,
    distance_m: f64,
    ticks: u64,
    step_s: f64,
}

impl Observer {
    /// Follows `run`, a run of the desk's case before its first tick.
    ///
    /// # Errors
    /// A damper whose parameters cannot be checked.
    pub fn new(desk: &Desk, run: &Run) -> Result<Self, ActionError> {
        let case = desk.case();
        let signals = all_signals(run, &case.vehicle);
        let names: Vec<String> = signals
            .iter()
            .map(|signal| signal.name().to_owned())
            .collect();
        let names = [names, filtered_names(&case.vehicle)].concat();
        // The windows of the indices have room for the slowest speed that an operator may choose.
        let mut slowest = case.clone();
        slowest.events.push(Event {
            time_s: case.duration_s,
            ramp_s: 0.0,
            change: Change::Speed(SPEED_KM_H[0] / 3.6),
        });
        let mut observer = Self {
            indexer: Indexer::new(&slowest),
            validity: ValidityWatch::new(case, run.track()),
            health: HealthWatch::new(desk)?,
            last: vec![0.0; names.len()],
            least: vec![f32::INFINITY; names.len()],
            greatest: vec![f32::NEG_INFINITY; names.len()],
            signals,
            names,
            ticks_in_frame: 0,
            time_s: run.time_s(),
            distance_m: run.state().distance_m(),
            ticks: run.state().ticks(),
            step_s: case.step_s,
        };
        observer.read(run.state());
        Ok(observer)
    }

    /// Names of the signals, as in a history.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Takes a tick.
    pub fn add(&mut self, ticks: u64, tick: &impl VehicleTick) {
        self.ticks = ticks;
        self.time_s = ticks as f64 * self.step_s;
        self.indexer.add(tick);
        self.validity.add(tick);
        self.health.add(tick);
        self.read(tick);
        self.ticks_in_frame += 1;
    }

    fn read(&mut self, tick: &impl VehicleTick) {
        self.distance_m = tick.distance_m();
        let time_s = self.time_s;
        let signals = self.signals.iter().map(|signal| signal.value(tick, time_s));
        let values = signals.chain(self.indexer.filtered());
        for (number, value) in values.enumerate() {
            let value = value as f32;
            self.last[number] = value;
            self.least[number] = self.least[number].min(value);
            self.greatest[number] = self.greatest[number].max(value);
        }
    }

    /// Last value of each signal.
    pub fn values(&self) -> &[f32] {
        &self.last
    }

    /// Health of the dampers.
    pub fn health(&self) -> Vec<HealthLine> {
        self.health.lines()
    }

    /// Results outside the validity of the model, in words.
    pub fn warnings(&self) -> Vec<String> {
        let warnings = self.validity.warnings();
        warnings.iter().map(ToString::to_string).collect()
    }

    /// Writes a frame, and begins the next. `run` is the number of the run on the page.
    pub fn frame(&mut self, run: u32, work_us: [f32; 2], flags: u32, to: &mut Vec<u8>) {
        to.clear();
        let numbers = self.names.len();
        to.reserve(HEADER_BYTES + 12 * numbers);
        to.extend(run.to_le_bytes());
        to.extend((numbers as u32).to_le_bytes());
        for value in [self.time_s, self.distance_m, self.ticks as f64] {
            to.extend(value.to_le_bytes());
        }
        for value in work_us {
            to.extend(value.to_le_bytes());
        }
        to.extend(self.ticks_in_frame.to_le_bytes());
        let outside = self.validity.longest_lift_s() > 0.0 && !self.validity.warnings().is_empty();
        let outside = if outside { flags::OUTSIDE_VALIDITY } else { 0 };
        to.extend((flags | outside).to_le_bytes());
        for values in [&self.last, &self.least, &self.greatest] {
            for value in values {
                to.extend(value.to_le_bytes());
            }
        }
        self.ticks_in_frame = 0;
        self.least.clone_from(&self.last);
        self.greatest.clone_from(&self.last);
    }
}
