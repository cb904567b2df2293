//! Bits of the model's results: forces of dampers and banks, of the contact, the state of a vehicle, and every index of
//! a few runs of vehicles.
//!
//! The runs cover every element of a vehicle, elastically supported rails, events, a damper that changes during the
//! run, and both laws of a damper.

mod contact;
mod damper;
mod indices;
#[cfg(target_family = "wasm")]
mod module;
mod vehicle;

use dashpot_files::case::Case;
use dashpot_files::study::StudyParameters;
use dashpot_study::sweep::{Study, digest_of_cells};
use serde::{Deserialize, Serialize};

/// The study of the runs, in the repository.
pub const STUDY: &str = "tests/physics/study/study.toml";

/// Loads the study of the runs from its file.
///
/// # Panics
/// If the file is not a study.
pub fn study(path: &str) -> Study {
    let parameters = StudyParameters::load(path).expect("the study of physics");
    Study::new(parameters).expect("the study of physics")
}

/// Runs and their indices, which need no other file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Runs {
    /// The case of each run.
    pub cases: Vec<Case>,
    /// Names of the indices.
    pub observed: Vec<String>,
}

impl Runs {
    /// The runs of a study.
    ///
    /// # Panics
    /// If a case cannot be built.
    pub fn of(study: &Study) -> Self {
        let cases = (0..study.cases()).filter_map(|number| study.case(number));
        let build = |case| {
            let case = study.build(&case).expect("a case");
            let track = case.track.resolved().expect("a track");
            Case { track, ..case }
        };
        Self {
            cases: cases.map(build).collect(),
            observed: study
                .observed
                .iter()
                .map(|index| index.name.to_owned())
                .collect(),
        }
    }
}

/// Results of the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Results {
    /// Digest of the forces of all presets and of every index of every run, which every row of a study contains.
    pub physics: String,
    /// Digest of each part.
    pub parts: Vec<Part>,
}

/// Results of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// What the results are.
    pub name: String,
    /// Digest of their bits.
    pub digest: String,
}

impl Results {
    /// Computes all results.
    ///
    /// # Panics
    /// If a run ends early or an index is missing.
    pub fn new(runs: &Runs) -> Self {
        let forces = damper::forces();
        let indices = indices::of_runs(runs);
        // Cells of a row are in the order of the runs, those of a part in the order of the indices.
        let mut cells = forces.both();
        cells.extend(indices.iter().flat_map(|run| run.iter().cloned()));
        let of_index = |index: usize| indices.iter().map(move |run| run[index].as_str());
        let mut parts = vec![
            part("damper, f32", forces.single.iter().map(String::as_str)),
            part("damper, f64", forces.double.iter().map(String::as_str)),
        ];
        for (name, bits) in [
            ("bank, f32", damper::bank::<f32>()),
            ("bank, f64", damper::bank::<f64>()),
            ("elastic contact", contact::elastic()),
            ("contact", contact::forces()),
            ("vehicle", vehicle::state()),
        ] {
            parts.push(part(name, bits.iter().map(String::as_str)));
        }
        let names = runs.observed.iter().enumerate();
        parts.extend(names.map(|(index, name)| part(name, of_index(index))));
        Self {
            physics: digest_of_cells(cells.iter().map(String::as_str)),
            parts,
        }
    }

    /// One line for each part: its name and its digest.
    pub fn text(&self) -> String {
        let parts = self.parts.iter();
        parts
            .map(|part| format!("{}; {}\n", part.name, part.digest))
            .collect()
    }
}

fn part<'a>(name: &str, bits: impl Iterator<Item = &'a str>) -> Part {
    Part {
        name: name.to_owned(),
        digest: digest_of_cells(bits),
    }
}

fn bits(number: f64) -> String {
    format!("{:016x}", number.to_bits())
}
