//! Indices of runs.

use dashpot_files::case::Case;
use dashpot_study::sweep::{Observed, Shared, observe};
use dashpot_vehicle_run::Ending;

use crate::{Runs, bits};

/// Every index of every run.
pub(super) fn of_runs(runs: &Runs) -> Vec<Vec<String>> {
    let shared = Shared::default();
    let observed: Vec<Observed> = runs
        .observed
        .iter()
        .map(|name| *Observed::by_name(name).expect("an index"))
        .collect();
    let of_run = |case| of_run(case, &observed, &shared);
    runs.cases.iter().map(of_run).collect()
}

fn of_run(case: &Case, observed: &[Observed], shared: &Shared) -> Vec<String> {
    let (ending, observation) = observe(case, shared, observed, &|| false).expect("a run");
    assert_eq!(ending, Ending::Completed, "{}", case.name);
    let observation = observation.expect("a run that completes has indices");
    let value = |index: &Observed| {
        let value = (index.extract)(&observation).filter(|value| value.is_finite());
        bits(value.unwrap_or_else(|| panic!("{}: no {}", case.name, index.name)))
    };
    observed.iter().map(value).collect()
}
