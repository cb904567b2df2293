//! Follows a run: its signals in frames, results outside the validity of the model, health of its dampers.

use dashpot_files::case::{Change, Event};
use dashpot_vehicle_run::recorded::all_signals;
use dashpot_vehicle_run::signals::Signal;
use dashpot_vehicle_run::{Indexer, Run, ValidityWatch, VehicleTick, filtered_names};

use crate::ActionError;
use crate::desk::{Desk, SPEED_KM_H};
use crate::frame::{Frame, FrameHead, flags};
use crate::health::{HealthLine, HealthWatch};

/// Follows a run tick by tick, without allocating in a tick.
#[derive(Debug, Clone)]
pub struct Observer {
    signals: Vec<Signal>,
    names: Vec<String>,
    indexer: Indexer,
    validity: ValidityWatch,
    health: HealthWatch,
    frame: Frame,
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
            frame: Frame::new(names.len()),
            signals,
            names,
            time_s: run.time_s(),
            distance_m: run.state().distance_m(),
            ticks: run.state().ticks(),
            step_s: case.step_s,
        };
        let start = values(
            &observer.signals,
            &observer.indexer,
            run.state(),
            run.time_s(),
        );
        observer.frame.read(start);
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
        self.distance_m = tick.distance_m();
        self.frame
            .add(values(&self.signals, &self.indexer, tick, self.time_s));
    }

    /// Last value of each signal.
    pub fn values(&self) -> &[f32] {
        self.frame.last()
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
        let outside = match self.validity.has_warnings() {
            true => flags::OUTSIDE_VALIDITY,
            false => 0,
        };
        let head = FrameHead {
            run,
            time_s: self.time_s,
            distance_m: self.distance_m,
            ticks: self.ticks,
            work_us,
            flags: flags | outside,
        };
        self.frame.write(&head, to);
    }
}

/// Values of all signals at a tick.
fn values(
    signals: &[Signal],
    indexer: &Indexer,
    tick: &impl VehicleTick,
    time_s: f64,
) -> impl Iterator<Item = f32> {
    let values = signals.iter().map(move |signal| signal.value(tick, time_s));
    values.chain(indexer.filtered()).map(|value| value as f32)
}
