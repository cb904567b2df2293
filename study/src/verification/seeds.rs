//! A chaotic case against the reference: by the means of its indices over seeds of the irregularity.

use serde::Serialize;

use super::VerificationError;
use super::deviations::indices;
use crate::verification::{reference, stepped};
use dashpot_files::case::Case;
use dashpot_vehicle_run::Ending;

/// Seeds.
pub const SEEDS: u64 = 8;

/// Relative tolerance of the reference: far below what seeds differ by.
const TOLERANCE: f64 = 1e-6;

/// Standard errors by which means may differ: of some hundred indices none is beyond four by chance in one of a hundred cases.
pub const STANDARD_ERRORS: f64 = 4.0;

/// Means of the indices over seeds, by the step and by the reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverSeeds {
    /// Seeds.
    pub seeds: u64,
    /// Greatest difference of two means over its standard error.
    pub greatest: f64,
    /// The index that has it.
    pub of: String,
    /// Its means by the step and by the reference.
    pub means: [f64; 2],
}

impl OverSeeds {
    /// Whether no mean differs by more than [`STANDARD_ERRORS`].
    pub fn agrees(&self) -> bool {
        self.greatest <= STANDARD_ERRORS
    }
}

/// Indices by the step and by the reference.
type Pair = [Vec<(f64, String)>; 2];

/// Runs a case with seeds 1 to [`SEEDS`] of its irregularity, on all cores; none when it has no seed or a run does not come to its end.
///
/// # Errors
/// As [`reference()`].
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
    Ok(Some([indices(&trace), indices(&solution)]))
}

/// The index whose means differ most for their spread.
fn compare(pairs: &[Pair]) -> Option<OverSeeds> {
    let count = pairs.len() as f64;
    let first = &pairs.first()?[0];
    let of_index = |number: usize| {
        let series = |side: usize| pairs.iter().map(move |pair| pair[side][number].0);
        let means = [0, 1].map(|side| series(side).sum::<f64>() / count);
        let variance = |side: usize| {
            let square = |value: f64| (value - means[side]).powi(2);
            series(side).map(square).sum::<f64>() / (count - 1.0)
        };
        let error = ((variance(0) + variance(1)) / count).sqrt();
        OverSeeds {
            seeds: pairs.len() as u64,
            greatest: (means[0] - means[1]).abs() / error,
            of: first[number].1.clone(),
            means,
        }
    };
    (0..first.len())
        .map(of_index)
        .max_by(|a, b| a.greatest.total_cmp(&b.greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_compared_by_their_spread() {
        let pair = |a: f64, b: f64| -> Pair {
            [a, b].map(|value| vec![(value, "index".to_owned()), (2.0, "other".to_owned())])
        };
        // Means 2 and 3, variances 1 and 1 of three: sqrt(2/3).
        let found = compare(&[pair(1.0, 2.0), pair(2.0, 3.0), pair(3.0, 4.0)]);
        let found = found.unwrap();
        assert_eq!((found.means, found.of.as_str()), ([2.0, 3.0], "index"));
        assert!((found.greatest - 1.5_f64.sqrt()).abs() < 1e-12);
        assert!(found.agrees());
    }
}
