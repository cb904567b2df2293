//! Curves that the figures of a study need.

use std::collections::{BTreeMap, BTreeSet};

use dashpot_files::study::{FigureContent, Sweep, Value};
use dashpot_vehicle_run::signals::slug;

use super::{CurveKey, CurveKind};
use crate::sweep::study::Study;

/// Signals and their forms that are recorded for each case. Cases without any are missing.
pub type Needed = BTreeMap<u64, BTreeSet<(String, CurveKind)>>;

/// True if a curve is needed.
pub fn is_needed(needed: &Needed, key: &CurveKey) -> bool {
    let of_case = needed.get(&key.case);
    of_case.is_some_and(|names| names.contains(&(key.signal.clone(), key.kind)))
}

impl Study {
    /// Returns the curves that the figures of the page draw.
    ///
    /// ```
    /// use dashpot_files::study::StudyParameters;
    /// use dashpot_study::sweep::Study;
    /// let study = Study::new(StudyParameters::load("paper")?)?;
    /// // Two figures of one case each, and three of a signal for three values and eight seeds.
    /// assert_eq!(study.needed_curves().len(), 1 + 1 + 3 * 3 * 8);
    /// # Ok::<(), dashpot_files::study::StudyFileError>(())
    /// ```
    pub fn needed_curves(&self) -> Needed {
        let mut needed = Needed::new();
        let mut add = |key: CurveKey| {
            let of_case = needed.entry(key.case).or_default();
            of_case.insert((key.signal, key.kind));
        };
        for figure in &self.parameters.figures {
            let names = figure.content.sweeps().iter();
            let sweeps = names.filter_map(|name| self.parameters.sweep(name));
            for sweep in sweeps {
                match &figure.content {
                    FigureContent::Dampers { dampers, .. } => {
                        let keys = dampers
                            .iter()
                            .flat_map(|name| self.damper_keys(sweep, name));
                        keys.for_each(&mut add);
                    }
                    FigureContent::Signal { values, signal, .. } => {
                        for value in values {
                            add(self.history_key(sweep, value, signal));
                            self.spectrum_keys(sweep, value, signal).for_each(&mut add);
                        }
                    }
                    FigureContent::Indices { .. } | FigureContent::Response { .. } => {}
                }
            }
        }
        needed
    }

    /// Histories of displacement and force of a damper in the first case of a sweep.
    pub fn damper_keys(&self, sweep: &Sweep, damper: &str) -> [CurveKey; 2] {
        let case = self.numbers(sweep, 0).start;
        ["displacement_m", "force_n"].map(|quantity| CurveKey {
            case,
            signal: format!("{}_{quantity}", slug(damper)),
            kind: CurveKind::History,
        })
    }

    /// History of a signal at a value of the first axis, for the first seed.
    pub fn history_key(&self, sweep: &Sweep, value: &Value, signal: &str) -> CurveKey {
        CurveKey {
            case: self.numbers(sweep, point(sweep, value)).start,
            signal: signal.to_owned(),
            kind: CurveKind::History,
        }
    }

    /// Spectra of a signal at a value of the first axis, one per seed.
    pub fn spectrum_keys<'a>(
        &self,
        sweep: &Sweep,
        value: &Value,
        signal: &'a str,
    ) -> impl Iterator<Item = CurveKey> + use<'a> {
        let cases = self.numbers(sweep, point(sweep, value));
        cases.map(move |case| CurveKey {
            case,
            signal: signal.to_owned(),
            kind: CurveKind::Spectrum,
        })
    }
}

/// Point of a sweep with this value of the first axis and the first value of every other axis.
fn point(sweep: &Sweep, value: &Value) -> u64 {
    let Some(first) = sweep.axes.first() else {
        return 0;
    };
    let others = sweep.points() / first.values.len() as u64;
    let at = first.values.iter().position(|other| other == value);
    at.unwrap_or(0) as u64 * others
}
