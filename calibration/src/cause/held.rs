//! Signals that keep their value although they cannot.

use super::{Cause, CauseKind, Recorded};

/// Minimum number of equal samples.
const MIN_RUN: usize = 20;

/// The other signal has to change by this share of its range meanwhile.
const MOVED_SHARE: f64 = 0.05;

/// Returns the signal that is held longest, with the share of its samples; `None` if neither is held.
pub(super) fn held(recorded: &Recorded) -> Option<Cause> {
    let (x, forces) = (&recorded.displacements_m, &recorded.forces_n);
    let least_m = MOVED_SHARE * range(x);
    let of_force = held_samples(forces, |run| range(&x[run]) > least_m);
    let least_n = MOVED_SHARE * range(forces);
    // While the ends stand still, the force of a damper only falls.
    let of_displacement = held_samples(x, |run| {
        let (first, greatest) = (forces[run.start].abs(), greatest(&forces[run]));
        greatest - first > least_n
    });
    let share = |samples: usize| samples as f64 / forces.len().max(1) as f64;
    let cause = |kind, samples: usize| Cause {
        kind,
        value: share(samples),
        probability: 1.0,
    };
    match of_force >= of_displacement {
        _ if of_force + of_displacement == 0 => None,
        true => Some(cause(CauseKind::ForceHeld, of_force)),
        false => Some(cause(CauseKind::DisplacementHeld, of_displacement)),
    }
}

fn held_samples(values: &[f64], is_held: impl Fn(std::ops::Range<usize>) -> bool) -> usize {
    let mut count = 0;
    let mut start = 0;
    for run in values.chunk_by(|a, b| a == b) {
        if run.len() >= MIN_RUN && is_held(start..start + run.len()) {
            count += run.len();
        }
        start += run.len();
    }
    count
}

fn greatest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |greatest: f64, value| greatest.max(value.abs()))
}

fn range(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (greatest - least).max(0.0)
}
