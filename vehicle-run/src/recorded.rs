//! Runs a case to its end and records its signals in memory.

use dashpot_rail::vehicle::VehicleParameters;

use super::signals::{self, Signal};
use super::{
    Ending, Indexer, Indices, Run, ValidityWatch, VehicleRunError, Warning, confirmed,
    filtered_names,
};
use dashpot_files::case::Case;
use dashpot_files::did_you_mean;
use dashpot_files::nearest_nanosecond;

/// Ticks between checks for cancellation.
const TICKS_PER_CHECK: u64 = 256;

/// Recorded run: its signals tick by tick, ending, indices and warnings.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// How the run ended.
    pub ending: Ending,
    /// Name of each signal and of each filtered force, and its value after each tick.
    pub history: Vec<(String, Vec<f64>)>,
    /// `None` if [`Ending::has_indices`] is false.
    pub indices: Option<Indices>,
    /// Results outside the validity of the model.
    pub warnings: Vec<Warning>,
}

/// Returns all signals of a run of `vehicle`, in the order of a history.
pub fn all_signals(run: &Run, vehicle: &VehicleParameters) -> Vec<Signal> {
    let mut all = signals::all(run.vehicle());
    all.extend(signals::ride(vehicle));
    all
}

/// Where a column of a history comes from.
#[derive(Clone)]
enum Source {
    Signal(Signal),
    /// Number of the value among the filtered forces.
    Filtered(usize),
}

/// Returns the columns with these names, in their order, or all columns without names.
fn chosen(
    signals: Vec<Signal>,
    filtered: &[String],
    names: Option<&[String]>,
) -> Result<Vec<(String, Source)>, VehicleRunError> {
    let signals = signals
        .into_iter()
        .map(|signal| (signal.name().to_owned(), Source::Signal(signal)));
    let filtered = filtered.iter().enumerate();
    let filtered = filtered.map(|(number, name)| (name.clone(), Source::Filtered(number)));
    let all: Vec<_> = signals.chain(filtered).collect();
    let Some(names) = names else {
        return Ok(all);
    };
    let mut chosen = Vec::with_capacity(names.len());
    for name in names {
        let Some((_, source)) = all.iter().find(|(known, _)| known == name) else {
            let known = all.iter().map(|(known, _)| known.as_str());
            return Err(VehicleRunError::NoSignal {
                name: name.clone(),
                near: did_you_mean(name, known),
            });
        };
        chosen.push((name.clone(), source.clone()));
    }
    Ok(chosen)
}

/// Runs `run`, which has not been stepped yet, to its end or until `is_cancelled` returns true. Records the named
/// signals, or all if `names` is `None`.
///
/// # Errors
/// Unknown signal, a history that does not fit into memory, or an error of [`Run::step`].
pub fn record(
    case: &Case,
    mut run: Run,
    names: Option<&[String]>,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Recorded, VehicleRunError> {
    let signals = all_signals(&run, &case.vehicle);
    let chosen = chosen(signals, &filtered_names(&case.vehicle), names)?;
    let ticks = run.ticks();
    let mut columns: Vec<Vec<f64>> = chosen.iter().map(|_| Vec::new()).collect();
    let count = usize::try_from(ticks).unwrap_or(usize::MAX);
    if columns
        .iter_mut()
        .any(|column| column.try_reserve_exact(count).is_err())
    {
        let signals = chosen.len();
        return Err(VehicleRunError::Memory { ticks, signals });
    }
    let mut filtered = Vec::new();
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case, run.track());
    let ending = loop {
        let ended = run.step()?;
        if ended == Some(Ending::Completed) {
            break Ending::Completed;
        }
        let time_s = nearest_nanosecond(run.time_s());
        indexer.add(run.state());
        filtered.clear();
        filtered.extend(indexer.filtered());
        for (column, (_, source)) in columns.iter_mut().zip(&chosen) {
            column.push(match source {
                Source::Signal(signal) => signal.value(run.state(), time_s),
                Source::Filtered(number) => filtered[*number],
            });
        }
        watch.add(run.state());
        if let Some(ended) = ended {
            break ended;
        }
        if run.state().ticks().is_multiple_of(TICKS_PER_CHECK) && is_cancelled() {
            break run.interrupted();
        }
    };
    let ending = confirmed(case, &run, ending)?;
    let names = chosen.into_iter().map(|(name, _)| name);
    Ok(Recorded {
        history: names.zip(columns).collect(),
        indices: indexer.indices().filter(|_| ending.has_indices()),
        warnings: watch.warnings(),
        ending,
    })
}
