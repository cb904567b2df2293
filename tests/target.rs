//! The core on an emulated Cortex-M7: instructions of a step, stack, bytes and force bits, each figure
//! within its row of `tests/support/target_budget.csv`.
//!
//! `cargo xtask target` prints what this measures; `DASHPOT_TARGET_REPORT` names a file for it as JSON.

use std::path::Path;

use dashpot::target::{BANK, Experiment, Found, STEP_S};
use dashpot::{damper, document};
use dashpot_core::Damper;
use dashpot_hil::excitation::Excitation;
use object::{Object, ObjectSection, ObjectSymbol, SectionKind};
use serde_json::{Map, Value, json};
use xtask::tools::{ARM_GCC, QEMU, have, have_target};
use xtask::{c_library, firmware};

/// Steps of one damper for a digest, and of a bank.
const STEPS: u32 = 1_000_000;
const BANK_STEPS: u32 = 100_000;

/// A row of the budget is at most the measured figure over this share, so one looser than needed fails.
const LEAST_USE: f64 = 0.8;
const BUDGET: &str = "tests/support/target_budget.csv";
const DIGESTS: &str = "tests/golden/target.txt";

/// Element in the tables, preset, bank.
const ELEMENTS: [(&str, &str, bool); 3] = [
    ("physical", "in-service", false),
    ("reduced", "reduced-vertical", false),
    ("bank", "in-service", true),
];

fn build(preset: &str) -> Damper<f32> {
    damper(preset, &[]).build(STEP_S).expect("a preset")
}

/// Every experiment, by the element's and the excitation's name.
fn experiments<R>(run: impl Fn(&Experiment<'_>) -> R) -> Vec<(&'static str, &'static str, R)> {
    let other = build("reduced-lateral");
    let mut found = Vec::new();
    for (element, preset, bank) in ELEMENTS {
        let damper = build(preset);
        for excitation in Excitation::ALL {
            let experiment = Experiment {
                damper: &damper,
                other: &other,
                excitation,
                bank,
                steps: if bank { BANK_STEPS } else { STEPS },
            };
            found.push((element, excitation.name(), run(&experiment)));
        }
    }
    found
}

fn digests<'a>(rows: impl Iterator<Item = (&'a str, &'a str, &'a str)>) -> String {
    let header = format!(
        "# element, excitation, digest of the force bits: {STEPS} steps, of a bank of {BANK} {BANK_STEPS}\n"
    );
    rows.fold(header, |text, (element, excitation, digest)| {
        text + &format!("{element}; {excitation}; {digest}\n")
    })
}

#[test]
fn this_machine_has_the_digests() {
    let found = experiments(|experiment| experiment.digest_here());
    let rows = found
        .iter()
        .map(|(element, excitation, digest)| (*element, *excitation, digest.as_str()));
    document::compare(DIGESTS, &digests(rows));
}

/// Code and constants (bytes) of the C library for the target, which has the core and its border, and
/// how many of its symbols panic, use a heap or compute in double precision.
fn library_figures(library: &Path) -> [(String, f64); 4] {
    let bytes = std::fs::read(library).expect("a library");
    let archive = object::read::archive::ArchiveFile::parse(&*bytes).expect("an archive");
    let (mut code, mut panics, mut heap, mut doubles) = (0, 0, 0, 0);
    for member in archive.members() {
        let member = member.expect("an archive's member");
        if !member.name().starts_with(b"dashpot") {
            continue;
        }
        let object = member.data(&*bytes).expect("a member's bytes");
        let object = object::File::parse(object).expect("an object file");
        for section in object.sections() {
            if matches!(
                section.kind(),
                SectionKind::Text | SectionKind::ReadOnlyData | SectionKind::ReadOnlyString
            ) {
                code += section.size();
            }
        }
        for symbol in object.symbols() {
            let name = symbol.name().unwrap_or_default();
            panics += u32::from(name.contains("panicking"));
            heap += u32::from(name.contains("alloc") || name.contains("free"));
            doubles += u32::from(is_soft_double(name));
        }
    }
    [
        ("code_and_constant_bytes".into(), code as f64),
        ("panic_symbols".into(), f64::from(panics)),
        ("heap_symbols".into(), f64::from(heap)),
        ("soft_double_symbols".into(), f64::from(doubles)),
    ]
}

/// Whether a function of the Arm run-time ABI or of GCC's computes with doubles.
fn is_soft_double(name: &str) -> bool {
    let abi = name.strip_prefix("__aeabi_");
    abi.is_some_and(|rest| rest.starts_with('d') || rest.contains("2d") || rest.contains("cdcmp"))
        || ["df2", "df3", "dfsf2"]
            .iter()
            .any(|end| name.ends_with(end))
}

/// The figures of the budget, by name.
fn figures(found: &[(&str, &str, Found)], library: &Path) -> Vec<(String, f64)> {
    let mut figures = Vec::new();
    for (element, _, bank) in ELEMENTS {
        let runs = || {
            found
                .iter()
                .filter(|(name, ..)| *name == element)
                .map(|(.., found)| found)
        };
        let mean = runs().map(|run| run.mean).sum::<f64>() / runs().count() as f64;
        let least = runs().map(|run| run.least).fold(f64::MAX, f64::min);
        let most = runs().map(|run| run.most).fold(0.0, f64::max);
        for (name, value) in [("mean", mean), ("least", least), ("most", most)] {
            figures.push((format!("{element}_{name}_instructions"), value));
        }
        if !bank {
            let first = runs().map(|run| run.first).fold(0.0, f64::max);
            let held = runs().map(|run| run.held).fold(0.0, f64::max);
            let swapped = runs().map(|run| run.swapped).fold(0.0, f64::max);
            figures.push((format!("{element}_first_step_instructions"), first));
            figures.push((format!("{element}_held_input_instructions"), held));
            figures.push((format!("{element}_swapped_damper_instructions"), swapped));
        }
    }
    let most = |figure: fn(&Found) -> u32| {
        f64::from(
            found
                .iter()
                .map(|(.., found)| figure(found))
                .max()
                .unwrap_or(0),
        )
    };
    figures.push(("stack_bytes".into(), most(|found| found.stack_bytes)));
    figures.push(("damper_bytes".into(), most(|found| found.damper_bytes)));
    figures.push(("state_bytes".into(), most(|found| found.state_bytes)));
    figures.extend(library_figures(library));
    figures
}

/// What is wrong with a figure and its row.
fn complaint(rows: &[(String, f64)], name: &str, value: f64) -> Option<String> {
    let Some((_, allowed)) = rows.iter().find(|(row, _)| row == name) else {
        return Some(format!("{name}: {value} has no row in {BUDGET}"));
    };
    if value > *allowed {
        Some(format!("{name}: {value} is above the {allowed} allowed"))
    } else if value < LEAST_USE * allowed {
        Some(format!(
            "{name}: {value} is far below the {allowed} allowed; tighten {BUDGET}"
        ))
    } else {
        None
    }
}

#[test]
fn the_target_keeps_its_budget_and_has_the_digests() {
    let what = "instructions, stack and force bits on a Cortex-M7";
    let Some(toolchain) = have_target(what).filter(|_| have(&[ARM_GCC, QEMU], what)) else {
        return;
    };
    let images = firmware::build(&toolchain).unwrap_or_else(|error| panic!("{error}"));
    let library = c_library::build_for_target(&toolchain).unwrap_or_else(|error| panic!("{error}"));
    let found = experiments(|experiment| experiment.on_target(&images.join("step-cost")));

    let figures = figures(&found, &library);
    let report: Map<String, Value> = figures
        .iter()
        .map(|(name, value)| (name.clone(), json!(value)))
        .collect();
    println!("{report:#?}");
    if let Some(path) = std::env::var_os("DASHPOT_TARGET_REPORT") {
        let text = serde_json::to_string_pretty(&report).expect("numbers");
        std::fs::write(&path, text + "\n").unwrap_or_else(|error| panic!("{path:?}: {error}"));
    }
    let rows = found
        .iter()
        .map(|(element, excitation, found)| (*element, *excitation, found.digest.as_str()));
    assert_eq!(
        digests(rows),
        document::read(DIGESTS),
        "the target's force bits differ"
    );

    let rows: Vec<(String, f64)> = document::read(BUDGET)
        .lines()
        .skip(1)
        .filter_map(|line| line.split_once(';'))
        .map(|(name, allowed)| {
            (
                name.trim().to_owned(),
                allowed.trim().parse().expect("a number"),
            )
        })
        .collect();
    let complaints: Vec<String> = figures
        .iter()
        .filter_map(|(name, value)| complaint(&rows, name, *value))
        .collect();
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    for (row, _) in &rows {
        let known = figures.iter().any(|(name, _)| name == row);
        assert!(known, "{row} in {BUDGET} is no figure");
    }
    for (element, excitation, run) in &found {
        assert_eq!(run.known, 101.0, "the count of a known function");
        assert_eq!(run.least, run.most, "{element}, {excitation}: one cost");
        if *element != "bank" {
            assert_eq!(run.first, run.most, "{element}, {excitation}: first step");
        }
    }
}

#[test]
fn a_budget_is_neither_exceeded_nor_far_too_large() {
    let rows = [("step".to_owned(), 150.0)];
    assert!(complaint(&rows, "step", 151.0).is_some_and(|text| text.contains("above")));
    assert!(complaint(&rows, "step", 119.0).is_some_and(|text| text.contains("far below")));
    assert!(complaint(&rows, "other", 1.0).is_some_and(|text| text.contains("no row")));
    assert_eq!(complaint(&rows, "step", 146.0), None);
}
