//! Checks a chaotic case against the reference: compares indices averaged over seeds of the track irregularity.

use serde::Serialize;

use super::VerificationError;
use super::deviations::{NamedIndex, indices};
use crate::verification::{reference, stepped};
use dashpot_files::case::Case;
use dashpot_vehicle_run::Ending;

/// Number of seeds.
pub const SEEDS: u64 = 8;

/// Relative tolerance of the reference; its error is far below the differences between seeds.
const TOLERANCE: f64 = 1e-6;

/// Maximum difference of two means in standard errors. With about a hundred indices, chance alone exceeds four standard
/// errors in about one of a hundred cases.
pub const STANDARD_ERRORS: f64 = 4.0;

/// Largest difference between the fixed step and the reference, of indices averaged over seeds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverSeeds {
    /// Number of seeds.
    pub seeds: u64,
    /// Largest difference of two means, in standard errors.
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
    /// True if no mean differs by more than [`STANDARD_ERRORS`].
    pub fn agrees(&self) -> bool {
        self.greatest <= STANDARD_ERRORS
    }
}

/// Indices of one seed.
struct Pair {
    step: Vec<NamedIndex>,
    reference: Vec<NamedIndex>,
}

/// Runs a case with seeds 1 to [`SEEDS`] of its irregularity, on all cores. Returns `None` if the irregularity has no
/// seed or a run does not complete.
///
/// # Errors
/// Same errors as [`reference()`].
pub fn over_seeds(case: &Case) -> Result<Option<OverSeeds>, VerificationError> {
    let seeds: Vec<u64> = (1..=SEEDS).collect();
    let pairs = dashpot_workers::map(&seeds, |seed| pair(case, *seed))?;
    let Some(pairs) = pairs.into_iter().collect::<Option<Vec<Pair>>>() else {
        return Ok(None);
    };
    Ok(compare(&pairs))
}

fn pair(case: &Case, seed: u64) -> Result<Option<Pair>, VerificationError> {
    let Some(track) = case.track.with_seed(seed) else {
        return Ok(None);
    };
    let case = Case {
        track,
        ..case.clone()
    };
    let (trace, ending) = stepped(&case, 1)?;
    if ending != Ending::Completed {
        return Ok(None);
    }
    let solution = reference(&case, &trace, TOLERANCE)?;
    Ok(Some(Pair {
        step: indices(&trace),
        reference: indices(&solution),
    }))
}

/// Returns the index whose means differ most, in standard errors.
fn compare(pairs: &[Pair]) -> Option<OverSeeds> {
    let count = pairs.len() as f64;
    let first = &pairs.first()?.step;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let variance = |values: &[f64], mean: f64| {
        let squares = values.iter().map(|value| (value - mean).powi(2));
        squares.sum::<f64>() / (count - 1.0)
    };
    let difference = |index: usize| {
        let step: Vec<f64> = pairs.iter().map(|pair| pair.step[index].value).collect();
        let reference = pairs.iter().map(|pair| pair.reference[index].value);
        let reference: Vec<f64> = reference.collect();
        let means = Means {
            step: mean(&step),
            reference: mean(&reference),
        };
        let variances = variance(&step, means.step) + variance(&reference, means.reference);
        OverSeeds {
            seeds: pairs.len() as u64,
            greatest: (means.step - means.reference).abs() / (variances / count).sqrt(),
            index: first[index].name.clone(),
            means,
        }
    };
    (0..first.len())
        .map(difference)
        .max_by(|a, b| a.greatest.total_cmp(&b.greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_compared_in_standard_errors() {
        let named = |value: f64, name: &str| NamedIndex {
            value,
            name: name.to_owned(),
        };
        let indices = |value: f64| vec![named(value, "index"), named(2.0, "other")];
        let pair = |step: f64, reference: f64| Pair {
            step: indices(step),
            reference: indices(reference),
        };
        // The means over the three seeds are 2 and 3, each with variance 1, so the standard error of their difference
        // is sqrt(2/3).
        let found = compare(&[pair(1.0, 2.0), pair(2.0, 3.0), pair(3.0, 4.0)]);
        let found = found.unwrap();
        let means = <[f64; 2]>::from(found.means);
        assert_eq!((means, found.index.as_str()), ([2.0, 3.0], "index"));
        assert!((found.greatest - 1.5_f64.sqrt()).abs() < 1e-12);
        assert!(found.agrees());
    }
}
