//! The digest of physics in every row of a study: the SHA-256 of the forces of all presets and of the indices of a few
//! runs (`tests/physics`).
//!
//! It is the same for every width of vectors. `tests/golden/physics.txt` has a digest of each part of the results,
//! which shows what a change of the model changes.
//!
//! `DASHPOT_BLESS=1` writes the digest into `study/src/sweep/physics.rs`, and into the kept rows that new runs
//! reproduce bit by bit, and the digests of the parts into their file.

use std::collections::BTreeSet;
use std::io::{Write, stderr};

use dashpot::document;
use dashpot_core::VectorWidth;
use dashpot_physics::{Results, Runs, STUDY};
use dashpot_rail::vehicle::Law;
use dashpot_rail::with_narrowest_vectors;
use dashpot_study::sweep::{OBSERVED, PHYSICS, ROW_DIGEST, Study, digest_of_cells};

use crate::rows::Kept;
use crate::{STUDIES, first_difference};

const SOURCE: &str = "study/src/sweep/physics.rs";

const PARTS: &str = "tests/golden/physics.txt";

fn study() -> Study {
    let path = document::in_repository(STUDY);
    dashpot_physics::study(&path.to_string_lossy())
}

/// Results of the model with the vectors of this thread.
fn computed() -> Results {
    Results::new(&Runs::of(&study()))
}

#[test]
fn the_digest_of_physics_is_that_of_the_model() {
    let results = computed();
    let [widest, narrowest] =
        [VectorWidth::detect(), VectorWidth::baseline()].map(VectorWidth::name);
    // Written past the capture of a test's output: the log says which vectors were compared.
    writeln!(stderr(), "physics: vectors compared: {widest}, {narrowest}").expect("standard error");
    assert_eq!(
        with_narrowest_vectors(self::computed),
        results,
        "the width of vectors must not change a bit"
    );
    document::compare(PARTS, &results.text());
    let computed = results.physics;
    if computed == PHYSICS {
        return;
    }
    assert!(
        document::blessing(),
        "the model behaves differently, and rows of studies must not mix: physics is {computed}, {SOURCE} has \
         {PHYSICS}; DASHPOT_BLESS=1 writes it there and into the kept rows where new runs have their bits"
    );
    let source = document::read(SOURCE);
    document::compare(SOURCE, &source.replace(PHYSICS, &computed));
    bless_kept_rows(&computed);
}

/// Writes the digest into the kept rows of those studies whose new runs (every 397th) have the same bits as before.
fn bless_kept_rows(computed: &str) {
    for name in STUDIES {
        let path = format!("data/studies/rows/{name}.csv");
        let difference = match Kept::read(name) {
            Ok(kept) => first_difference(&kept),
            Err(error) => Some(error.to_string()),
        };
        if let Some(difference) = difference {
            eprintln!(
                "{path} stays unchanged: {difference}; `cargo xtask vehicle-validation` computes all rows again"
            );
            continue;
        }
        let text = document::read(&path);
        document::compare(&path, &with_physics(&text, computed));
    }
}

/// Replaces the digest of physics in the rows, and the digests of their cells.
fn with_physics(text: &str, computed: &str) -> String {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let column = |name| {
        let mut names = header.iter();
        names.position(|column| column == name).expect("a column")
    };
    let [physics, digest] = ["physics", ROW_DIGEST].map(column);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(&header).expect("in memory");
    for record in reader.records() {
        let record = record.expect("a row");
        let mut cells: Vec<String> = record.iter().map(str::to_owned).collect();
        cells[physics] = computed.to_owned();
        cells[digest] = digest_of_cells(cells[..digest].iter().map(String::as_str));
        writer.write_record(&cells).expect("in memory");
    }
    String::from_utf8(writer.into_inner().expect("in memory")).expect("text")
}

#[test]
fn the_runs_have_every_element_and_every_index() {
    let study = study();
    let observed: BTreeSet<&str> = study.observed.iter().map(|index| index.name).collect();
    assert_eq!(observed, OBSERVED.iter().map(|index| index.name).collect());
    let parameters = study.case(0).expect("a case");
    let case = study.build(&parameters).expect("a case");
    // If you add a law, add an element with it to the vehicle of the study.
    let elements = case.vehicle.elements.iter();
    let laws: BTreeSet<&str> = elements.map(|element| element.law.name()).collect();
    assert_eq!(laws, Law::NAMES.iter().copied().collect());
    assert!(case.rails.is_some() && !case.faults.is_empty() && !case.events.is_empty());
}
