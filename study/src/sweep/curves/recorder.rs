//! Records signals during a run and turns them into curves.

use std::collections::BTreeSet;

use dashpot_vehicle_run::signals::{self, Signal};
use dashpot_vehicle_run::spectra::{SHOWN_HZ, Spectrum};
use dashpot_vehicle_run::{Run, VehicleTick};

use super::{Curve, CurveKind};

/// Histories of signals of a run.
pub struct Recorder {
    step_s: f64,
    signals: Vec<(Signal, Vec<f64>)>,
}

impl Recorder {
    /// Starts to record the signals with these names, those that the vehicle has.
    pub fn new<'a>(run: &Run, names: impl Iterator<Item = &'a str>) -> Self {
        let names: BTreeSet<&str> = names.collect();
        let all = match names.is_empty() {
            true => Vec::new(),
            false => signals::all(run.vehicle()),
        };
        let chosen = all
            .into_iter()
            .filter(|signal| names.contains(signal.name()));
        Self {
            step_s: run.vehicle().step_s(),
            signals: chosen.map(|signal| (signal, Vec::new())).collect(),
        }
    }

    /// Adds a tick that ended at `time_s`.
    pub fn add(&mut self, tick: &impl VehicleTick, time_s: f64) {
        for (signal, values) in &mut self.signals {
            values.push(signal.value(tick, time_s));
        }
    }

    /// Returns the curve of a signal; `None` if the vehicle does not have it, or for a spectrum at a step without one.
    pub fn curve(&self, name: &str, kind: CurveKind) -> Option<Curve> {
        let mut signals = self.signals.iter();
        let (_, history) = signals.find(|(signal, _)| signal.name() == name)?;
        let values = match kind {
            CurveKind::History => history.clone(),
            CurveKind::Spectrum => {
                let mut spectrum = Spectrum::new(name.to_owned(), self.step_s).ok()?;
                history.iter().for_each(|value| spectrum.add(*value));
                let shown = spectrum.density().into_iter();
                let shown = shown.take_while(|[frequency_hz, _]| *frequency_hz <= SHOWN_HZ);
                shown.flatten().collect()
            }
        };
        Some(Curve {
            step_s: self.step_s,
            values,
        })
    }
}
