//! Checks a chaotic case against the reference: compares the distributions of its indices over seeds of the track
//! irregularity.

use serde::Serialize;

use super::VerificationError;
use super::compared::Compared;
use crate::verification::{reference, stepped};
use dashpot_files::case::Case;
use dashpot_vehicle_run::Ending;

/// Number of seeds.
pub const SEEDS: u64 = 16;

/// Relative tolerance of the reference; its error is far below the differences between seeds.
const TOLERANCE: f64 = 1e-6;

/// Maximum difference of two means in standard errors. With a few hundred indices, chance alone exceeds four standard
/// errors in about one of a hundred cases.
pub const STANDARD_ERRORS: f64 = 4.0;

/// Maximum distance of two cumulative distributions (Kolmogorov and Smirnov). For twice 16 values, chance alone exceeds
/// it for one index in four thousand.
pub const DISTANCE: f64 = 0.75;

/// Difference between the distributions of indices with the fixed step and with the reference over seeds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverSeeds {
    /// Number of seeds.
    pub seeds: u64,
    /// Largest difference of two means, in standard errors.
    pub mean: Difference,
    /// Largest distance of two cumulative distributions.
    pub distribution: Difference,
}

/// Largest difference, and the index with this difference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// Size of the difference.
    pub greatest: f64,
    /// Index with this difference.
    #[serde(rename = "of")]
    pub index: String,
    /// Means of this index over the seeds.
    pub means: Means,
}

/// Means of an index over the seeds; serialized as a list of the two means.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(into = "[f64; 2]")]
pub struct Means {
    /// Mean from the runs with the fixed step.
    pub step: f64,
    /// Mean from the runs with the reference solver.
    pub reference: f64,
}

impl From<Means> for [f64; 2] {
    fn from(means: Means) -> Self {
        [means.step, means.reference]
    }
}

impl OverSeeds {
    /// True if no mean differs by more than [`STANDARD_ERRORS`], and no distribution by more than [`DISTANCE`].
    pub fn agrees(&self) -> bool {
        self.mean.greatest <= STANDARD_ERRORS && self.distribution.greatest <= DISTANCE
    }
}

/// Indices of one seed.
struct Pair {
    step: Vec<Compared>,
    reference: Vec<Compared>,
}

/// Result of [`over_seeds`].
#[derive(Debug, Clone, PartialEq)]
pub enum Seeds {
    /// The distributions were compared.
    Compared(OverSeeds),
    /// The track's irregularity has no seed.
    NoSeed,
    /// The run with a seed did not complete.
    Ended {
        /// The seed.
        seed: u64,
        /// How its run ended.
        ending: Ending,
    },
}

/// Runs a case with seeds 1 to [`SEEDS`] of its irregularity, on all cores.
///
/// # Errors
/// Same errors as [`reference()`].
pub fn over_seeds(case: &Case) -> Result<Seeds, VerificationError> {
    let seeds: Vec<u64> = (1..=SEEDS).collect();
    if case.track.with_seed(seeds[0]).is_none() {
        return Ok(Seeds::NoSeed);
    }
    let mut pairs = Vec::new();
    for (seed, pair) in (1..).zip(dashpot_workers::map(&seeds, |seed| pair(case, *seed))?) {
        match pair {
            Ok(pair) => pairs.push(pair),
            Err(ending) => return Ok(Seeds::Ended { seed, ending }),
        }
    }
    Ok(compare(&pairs).map_or(Seeds::NoSeed, Seeds::Compared))
}

/// Runs a case with a seed by both solvers; returns the ending of a run that does not complete.
fn pair(case: &Case, seed: u64) -> Result<Result<Pair, Ending>, VerificationError> {
    let track = case.track.with_seed(seed);
    let track = track.unwrap_or_else(|| case.track.clone());
    let case = Case {
        track,
        ..case.clone()
    };
    let (trace, ending) = stepped(&case, 1)?;
    if ending != Ending::Completed {
        return Ok(Err(ending));
    }
    let solution = reference(&case, &trace, TOLERANCE)?;
    Ok(Ok(Pair {
        step: trace.compared(),
        reference: solution.compared(),
    }))
}

/// Returns the indices whose means and whose distributions differ most.
fn compare(pairs: &[Pair]) -> Option<OverSeeds> {
    let first = &pairs.first()?.step;
    let differences = (0..first.len()).map(|index| {
        let values = |of: fn(&Pair) -> &Vec<Compared>| -> Vec<f64> {
            pairs.iter().map(|pair| of(pair)[index].value).collect()
        };
        let (step, reference) = (values(|pair| &pair.step), values(|pair| &pair.reference));
        let means = Means {
            step: mean(&step),
            reference: mean(&reference),
        };
        let of = |greatest: f64| Difference {
            greatest,
            index: first[index].name.clone(),
            means,
        };
        [
            of(standard_errors(&step, &reference, first[index].scale)),
            of(distance(step, reference, 1e-3 * first[index].scale)),
        ]
    });
    let greater = |a: Difference, b: Difference| if b.greatest > a.greatest { b } else { a };
    let [mean, distribution] = differences.reduce(|[mean, distribution], [other, others]| {
        [greater(mean, other), greater(distribution, others)]
    })?;
    Some(OverSeeds {
        seeds: pairs.len() as u64,
        mean,
        distribution,
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Difference of two means in standard errors. An error below a thousandth of the index's scale counts as that much.
fn standard_errors(step: &[f64], reference: &[f64], scale: f64) -> f64 {
    let variance = |values: &[f64]| {
        let mean = mean(values);
        let squares = values.iter().map(|value| (value - mean).powi(2));
        squares.sum::<f64>() / (values.len() as f64 - 1.0)
    };
    let error = ((variance(step) + variance(reference)) / step.len() as f64).sqrt();
    (mean(step) - mean(reference)).abs() / error.max(1e-3 * scale)
}

/// Greatest distance of two cumulative distributions; values that differ by `resolution` at most count as equal.
fn distance(mut step: Vec<f64>, mut reference: Vec<f64>, resolution: f64) -> f64 {
    step.sort_by(f64::total_cmp);
    reference.sort_by(f64::total_cmp);
    let share = |values: &[f64], limit: f64| {
        values.partition_point(|value| *value <= limit) as f64 / values.len() as f64
    };
    let places = step.iter().chain(&reference);
    let distances = places.map(|place| {
        let above = place + resolution;
        let forward = share(&step, *place) - share(&reference, above);
        let back = share(&reference, *place) - share(&step, above);
        forward.max(back)
    });
    distances.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn indices(value: f64) -> Vec<Compared> {
        let named = |value: f64, name: &str| Compared {
            name: name.to_owned(),
            value,
            scale: 0.0,
            is_extreme: false,
        };
        vec![named(value, "index"), named(2.0, "other")]
    }

    fn pair(step: f64, reference: f64) -> Pair {
        Pair {
            step: indices(step),
            reference: indices(reference),
        }
    }

    /// The means over the three seeds are 2 and 3, each with variance 1, so the standard error of their difference is
    /// sqrt(2/3).
    #[test]
    fn means_are_compared_in_standard_errors() {
        let found = compare(&[pair(1.0, 2.0), pair(2.0, 3.0), pair(3.0, 4.0)]).unwrap();
        let means = <[f64; 2]>::from(found.mean.means);
        assert_eq!((means, found.mean.index.as_str()), ([2.0, 3.0], "index"));
        assert!((found.mean.greatest - 1.5_f64.sqrt()).abs() < 1e-12);
        assert!(found.agrees());
    }

    /// Equal means, but the step spreads the index over a range in which the reference has no value.
    #[test]
    fn distributions_with_equal_means_are_told_apart() {
        let pairs: Vec<Pair> = (0..16)
            .map(|seed| {
                let away = if seed % 2 == 0 { -1.0 } else { 1.0 };
                pair(5.0 + 10.0 * away, 5.0 + 1e-3 * f64::from(seed) - 7.5e-3)
            })
            .collect();
        let found = compare(&pairs).unwrap();
        assert!(found.mean.greatest < 1e-9, "{found:?}");
        assert_eq!(found.distribution.greatest, 0.5);
    }

    #[test]
    fn values_within_the_resolution_are_one_value() {
        let of = |shift: f64| (0..16).map(|k| f64::from(k) + shift).collect::<Vec<f64>>();
        assert_eq!(distance(of(0.0), of(0.01), 0.02), 0.0);
        assert_eq!(distance(of(0.0), of(100.0), 0.02), 1.0);
    }
}
