//! The digest of physics in every row of a study: the SHA-256 of the forces of all presets and of the indices of a few
//! runs. The runs cover every element of a vehicle, elastically supported rails, a damper that changes during the run,
//! both laws of a damper and every index.
//!
//! Both digests, with and without fused multiply-add, are those of an x86-64 processor that supports it. On other
//! processors, the system library may round sines and exponentials differently.
//!
//! `DASHPOT_BLESS=1` writes both digests into `study/src/sweep/physics.rs`, and into the kept rows that new
//! runs reproduce bit by bit.

use std::collections::BTreeSet;

use dashpot::document;
use dashpot_core::Damper;
use dashpot_files::damper::{self, PRESETS};
use dashpot_files::study::StudyParameters;
use dashpot_rail::vehicle::Law;
use dashpot_rail::without_fused_multiplication;
use dashpot_study::sweep::{
    Arithmetic, OBSERVED, ROW_DIGEST, Shared, Study, digest_of_cells, physics, row,
};
use dashpot_testbench::excitation::Excitation;

use crate::rows::Kept;
use crate::{STUDIES, first_difference};

const STUDY: &str = "tests/vehicle_validation/physics/study.toml";
const SOURCE: &str = "study/src/sweep/physics.rs";

/// Number of ticks of the synthetic ride that drives each preset.
const TICKS: usize = 3000;

fn study() -> Study {
    let path = document::in_repository(STUDY);
    let parameters = StudyParameters::load(&path.to_string_lossy()).expect("the study of physics");
    Study::new(parameters).expect("the study of physics")
}

/// Bits of the model's results with the arithmetic of this thread.
fn results() -> Vec<String> {
    let mut results = Vec::new();
    let bits = |number: f64| format!("{:016x}", number.to_bits());
    let motion = Excitation::Ride.displacements_m(1e-3);
    for (name, _) in PRESETS {
        let parameters = damper::load(name, &[]).expect("a preset");
        let single: Damper<f32> = parameters.build(1e-3).expect("a preset");
        let double: Damper<f64> = parameters.build(1e-3).expect("a preset");
        let start = motion[0];
        let (mut in_single, mut in_double) = (single.at_rest(start as f32), double.at_rest(start));
        for displacement_m in motion.iter().take(TICKS) {
            let force = single.step(&mut in_single, *displacement_m as f32);
            results.push(bits(f64::from(force)));
            results.push(bits(double.step(&mut in_double, *displacement_m)));
        }
    }
    let (study, shared) = (study(), Shared::default());
    for number in 0..study.cases() {
        let row = row(&study, number, &shared, &|| false)
            .expect("a run")
            .expect("a case");
        assert_eq!(row.ending, "completed", "case {number}");
        for (index, value) in study.observed.iter().zip(&row.observed) {
            let value = value.unwrap_or_else(|| panic!("case {number}: no {}", index.name));
            results.push(bits(value));
        }
    }
    results
}

/// Both digests with their arithmetic; empty on processors for which they are not defined.
fn computed() -> Vec<(Arithmetic, String)> {
    if !cfg!(target_arch = "x86_64") || Arithmetic::here() != Arithmetic::Fused {
        eprintln!(
            "the digests of physics are those of x86-64 with fused multiply-add: not compared here"
        );
        return Vec::new();
    }
    let with = || {
        let results = results();
        let digest = digest_of_cells(results.iter().map(String::as_str));
        (Arithmetic::here(), digest)
    };
    let separate =
        without_fused_multiplication(with).expect("x86-64 has instructions without fusing");
    vec![with(), separate]
}

/// Replaces the digest of an arithmetic in its line of `text`.
fn with_digest(text: &str, arithmetic: Arithmetic, digest: &str) -> String {
    let start = format!("const {}: &str = \"", arithmetic.word().to_uppercase());
    let at = text.find(&start).expect("its line") + start.len();
    format!("{}{digest}{}", &text[..at], &text[at + digest.len()..])
}

#[test]
fn the_digest_of_physics_is_that_of_the_model() {
    let computed = computed();
    let differ = |(arithmetic, digest): &&(Arithmetic, String)| physics(*arithmetic) != digest;
    let Some((arithmetic, digest)) = computed.iter().find(differ) else {
        return;
    };
    assert!(
        document::blessing(),
        "the model behaves differently, and rows of studies must not mix: physics of {arithmetic} arithmetic is \
         {digest}, {SOURCE} has {}; DASHPOT_BLESS=1 writes it there and into the kept rows where new runs have their \
         bits",
        physics(*arithmetic)
    );
    let mut source = document::read(SOURCE);
    for (arithmetic, digest) in &computed {
        source = with_digest(&source, *arithmetic, digest);
    }
    document::compare(SOURCE, &source);
    bless_kept_rows(&computed);
}

/// Writes the digests into the kept rows of those studies whose new runs (every 397th) have the same bits as before.
fn bless_kept_rows(computed: &[(Arithmetic, String)]) {
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

/// Replaces the digests of physics in the rows, and the digests of their cells.
fn with_physics(text: &str, computed: &[(Arithmetic, String)]) -> String {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let column = |name| {
        let mut names = header.iter();
        names.position(|column| column == name).expect("a column")
    };
    let [arithmetic, physics, digest] = ["arithmetic", "physics", ROW_DIGEST].map(column);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(&header).expect("in memory");
    for record in reader.records() {
        let record = record.expect("a row");
        let mut cells: Vec<String> = record.iter().map(str::to_owned).collect();
        let of = |(one, _): &&(Arithmetic, String)| one.word() == cells[arithmetic];
        if let Some((_, new)) = computed.iter().find(of) {
            cells[physics].clone_from(new);
            cells[digest] = digest_of_cells(cells[..digest].iter().map(String::as_str));
        }
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
    assert!(case.rails.is_some() && !case.faults.is_empty());
}
