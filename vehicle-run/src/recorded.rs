//! Runs a case to its end and records its signals in memory.

use dashpot_rail::vehicle::VehicleParameters;

use super::signals::{self, Signal};
use super::{Ending, Indexer, Indices, Run, ValidityWatch, VehicleRunError, Warning, confirmed};
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
    /// Name of each signal and its value after each tick.
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
    let mut chosen = all_signals(&run, &case.vehicle);
    if let Some(names) = names {
        let find = |name: &String| match chosen.iter().find(|signal| signal.name() == name) {
            Some(signal) => Ok(signal.clone()),
            None => Err(VehicleRunError::NoSignal {
                name: name.clone(),
                near: did_you_mean(name, chosen.iter().map(Signal::name)),
            }),
        };
        chosen = names.iter().map(find).collect::<Result<_, _>>()?;
    }
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
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case);
    let ending = loop {
        let ended = run.step()?;
        if ended == Some(Ending::Completed) {
            break Ending::Completed;
        }
        let time_s = nearest_nanosecond(run.time_s());
        for (column, signal) in columns.iter_mut().zip(&chosen) {
            column.push(signal.value(run.state(), time_s));
        }
        indexer.add(run.state());
        watch.add(run.state());
        if let Some(ended) = ended {
            break ended;
        }
        if run.state().ticks().is_multiple_of(TICKS_PER_CHECK) && is_cancelled() {
            break run.interrupted();
        }
    };
    let ending = confirmed(case, &run, ending)?;
    let names = chosen.iter().map(|signal| signal.name().to_owned());
    Ok(Recorded {
        history: names.zip(columns).collect(),
        indices: indexer.indices().filter(|_| ending.has_indices()),
        warnings: watch.warnings(),
        ending,
    })
}
