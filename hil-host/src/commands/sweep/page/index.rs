//! An observed index in a figure: its name in words, its meaning and its values.

use super::Drawn;
use super::words::{Words, of_index};
use crate::commands::raw_name::in_words;
use dashpot_files::study::Sweep;

/// An observed index in a figure.
pub(super) struct Index {
    /// Position among the observed indices.
    pub(super) number: usize,
    /// Factor applied to the values.
    pub(super) factor: Option<f64>,
}

impl Index {
    fn words(&self, drawn: &Drawn<'_>) -> Words {
        of_index(drawn.study.observed[self.number].name)
    }

    /// Returns the index in words, with its unit and the factor.
    pub(super) fn name(&self, drawn: &Drawn<'_>) -> String {
        let label = self.words(drawn).label;
        match self.factor {
            Some(factor) if factor != 1.0 => format!("{label} × {factor}"),
            _ => label,
        }
    }

    /// Returns the factor from a value in a row to what the name states.
    fn scale(&self, drawn: &Drawn<'_>) -> f64 {
        self.words(drawn).scale * self.factor.unwrap_or(1.0)
    }
}

/// Explains each index.
pub(super) fn meanings(drawn: &Drawn<'_>, observed: &[Index]) -> String {
    let sentences = observed.iter().map(|index| {
        let label = index.words(drawn).label;
        let what = label.rsplit_once(", ").map_or(&*label, |(what, _)| what);
        let mut letters = what.chars();
        let first = letters.next().map(char::to_uppercase);
        let first: String = first.into_iter().flatten().collect();
        let observed = &drawn.study.observed[index.number];
        // The label has the unit, perhaps another one.
        let raw = in_words(observed.name);
        let unit = raw.rsplit_once(", ").map(|(_, unit)| format!(", {unit}"));
        let meaning = observed.meaning;
        let meaning = unit.map_or(meaning, |unit| meaning.trim_end_matches(&*unit));
        format!("{first}{}: {meaning}.", letters.as_str())
    });
    sentences.collect::<Vec<_>>().join(" ")
}

/// Values of an index at a point of a sweep, one per seed: scaled, or the change from the first value of the first axis
/// in percent.
pub(super) fn values(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    point: u64,
    index: &Index,
    changes: bool,
) -> Vec<Option<f64>> {
    let own = drawn.seed_values(sweep, point, index.number);
    if !changes {
        let scale = index.scale(drawn);
        return own.iter().map(|y| Some((*y)? * scale)).collect();
    }
    let others = sweep.points() / sweep.axes[0].values.len() as u64;
    let first = drawn.seed_values(sweep, point % others, index.number);
    let pairs = own.iter().zip(&first);
    pairs
        .map(|(y, first)| Some(1e2 * ((*y)? / (*first)? - 1.0)))
        .collect()
}
