//! Measures the core on emulated processors: instructions of a step, stack, bytes and force bits. Each figure must be
//! within its row of `tests/support/target_budget.csv`.
//!
//! `cargo xtask target` prints these measurements; `DASHPOT_TARGET_REPORT` names a JSON file for them. With
//! `DASHPOT_BLESS=1`, the test updates the limits and the tables of the documents to the measurements.

use std::fmt::Write;

use dashpot::budget::{Budget, Figures};
use dashpot::document;
use dashpot::library::library_figures;
use dashpot::standalone_count::standalone_figures;
use dashpot::target::{ELEMENTS, Found, experiments};
use serde_json::{Map, Value, json};
use xtask::processor::{CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor};
use xtask::target_toolchain::TargetToolchain;
use xtask::tools::{ARM_GCC, QEMU, have, have_target};
use xtask::{c_library, firmware};

const BUDGET: &str = "tests/support/target_budget.csv";
const CONTRACT: &str = "docs/timing-contract.md";

/// Column of the Cortex-M7 with a distribution's compiler, in addition to the default one.
const DISTRIBUTION: &str = "cortex_m7_distribution";

/// Maximum instructions of a step in C without a library, relative to the core (%).
const MAX_STANDALONE_SHARE: f64 = 110.0;

/// Processor and toolchain of a column.
struct Column {
    name: &'static str,
    toolchain: TargetToolchain,
    processor: Processor,
    /// Fraction of the steps that is run.
    share: f64,
}

/// The columns that this machine can measure: those of the first choice of compiler, and the Cortex-M7 with a
/// distribution's compiler if that is a different compiler.
fn columns() -> Vec<Column> {
    let mut columns = Vec::new();
    for (processor, share) in [(CORTEX_M7, 1.0), (CORTEX_M4F, 0.1), (CORTEX_M33, 0.1)] {
        let what = format!("instructions, stack and force bits on {}", processor.name);
        let toolchain = have_target(processor.target, &what);
        columns.extend(toolchain.map(|toolchain| Column {
            name: processor.name,
            toolchain,
            processor,
            share,
        }));
    }
    let second = TargetToolchain::distribution().filter(|_| {
        let installed = TargetToolchain::installed(CORTEX_M7.target);
        installed.is_some()
    });
    columns.extend(second.map(|toolchain| Column {
        name: DISTRIBUTION,
        toolchain,
        processor: CORTEX_M7,
        share: 0.1,
    }));
    columns
}

fn measure(column: &Column) -> Figures {
    let images = firmware::build(&column.toolchain, &column.processor);
    let images = images.unwrap_or_else(|error| panic!("{error}"));
    let library = c_library::build_for(&column.toolchain, &column.processor);
    let library = library.unwrap_or_else(|error| panic!("{error}"));
    let mut runs = Vec::new();
    for experiment in experiments(column.share) {
        let run = experiment.on(&column.processor, &images.join("step-cost"));
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        let label = format!("{}, {element}, {excitation}", column.name);
        assert_eq!(run.known, 101.0, "{label}: the count of a known function");
        assert_eq!(run.least, run.most, "{label}: one cost");
        if !experiment.bank {
            assert_eq!(run.first, run.most, "{label}: first step");
        }
        let expected = experiment.digest_here();
        assert_eq!(run.digest, expected, "{label}: the force bits differ");
        runs.push((element, run));
    }
    let mut figures = step_figures(&runs);
    figures.extend(library_figures(&library));
    figures.extend(standalone_figures(&column.processor));
    let share = share_of_the_core(&figures);
    figures.push(("standalone_percent_of_the_core".into(), share));
    figures
}

/// Instructions of a step in C without a library relative to the core (%); fails above the promise.
fn share_of_the_core(figures: &Figures) -> f64 {
    let figure = |name: &str| {
        let found = figures.iter().find(|(figure, _)| figure == name);
        found.unwrap_or_else(|| panic!("no {name}")).1
    };
    let share =
        100.0 * figure("standalone_most_instructions") / figure("physical_most_instructions");
    assert!(
        share <= MAX_STANDALONE_SHARE,
        "C without a library takes {share:.1} % of the core's instructions"
    );
    share.round()
}

/// Figures of the runs, by name.
fn step_figures(runs: &[(&str, Found)]) -> Figures {
    let most = |runs: &[&Found], figure: &dyn Fn(&Found) -> f64| {
        runs.iter().map(|run| figure(run)).fold(0.0, f64::max)
    };
    let mut figures = Vec::new();
    let mut all: Vec<&Found> = Vec::new();
    for (element, _, bank) in ELEMENTS {
        let of_element = runs.iter().filter(|(name, _)| *name == element);
        let runs: Vec<&Found> = of_element.map(|(_, run)| run).collect();
        let mean = runs.iter().map(|run| run.mean).sum::<f64>() / runs.len() as f64;
        let least = runs.iter().map(|run| run.least).fold(f64::MAX, f64::min);
        let mut add = |name: &str, value| {
            figures.push((format!("{element}_{name}_instructions"), value));
        };
        add("mean", mean);
        add("least", least);
        add("most", most(&runs, &|run| run.most));
        if !bank {
            add("first_step", most(&runs, &|run| run.first));
            add("held_input", most(&runs, &|run| run.held));
            add("limited_input", most(&runs, &|run| run.limited));
            add("jumped_input", most(&runs, &|run| run.jumped));
            add("swapped_damper", most(&runs, &|run| run.swapped));
        }
        all.extend(runs);
    }
    for (index, (name, _)) in all[0].library.iter().enumerate() {
        let value = most(&all, &|run| run.library[index].1);
        figures.push((format!("c_{name}_instructions"), value));
    }
    figures.push((
        "load_slice_instructions".into(),
        most(&all, &|run| run.load_slice),
    ));
    figures.push(("stack_bytes".into(), most(&all, &|run| run.stack_bytes)));
    figures.push(("damper_bytes".into(), most(&all, &|run| run.damper_bytes)));
    figures.push(("state_bytes".into(), most(&all, &|run| run.state_bytes)));
    figures
}

#[test]
fn every_processor_keeps_its_budget_and_has_the_hosts_bits() {
    let what = "instructions, stack and force bits on emulated processors";
    if !have(&[ARM_GCC, QEMU], what) {
        return;
    }
    let columns = columns();
    // The columns are measured one after the other, because each needs a build and an emulator that occupies a core.
    let measured: Vec<(&Column, Figures)> = columns
        .iter()
        .map(|column| (column, measure(column)))
        .collect();

    if let Some(path) = std::env::var_os("DASHPOT_TARGET_REPORT") {
        let object = |figures: &Figures| -> Map<String, Value> {
            let pairs = figures.iter();
            pairs
                .map(|(name, value)| (name.clone(), json!(value)))
                .collect()
        };
        let report: Map<String, Value> = measured
            .iter()
            .map(|(column, figures)| (column.name.to_owned(), object(figures).into()))
            .collect();
        let text = serde_json::to_string_pretty(&report).expect("numbers");
        std::fs::write(&path, text + "\n").unwrap_or_else(|error| panic!("{path:?}: {error}"));
    }
    let mut budget = Budget::read(BUDGET);
    if document::blessing() {
        for (column, figures) in &measured {
            budget.adapt(column.name, figures);
        }
        document::compare(BUDGET, &budget.text());
    }
    let complaints: Vec<String> = measured
        .iter()
        .flat_map(|(column, figures)| budget.complaints(column.name, figures))
        .collect();
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    compare_documents(&measured);
}

/// Rows of the documents' tables: title and figures.
const ROWS: [(&str, &[&str]); 24] = [
    (
        "instructions of a step: minimum, mean, maximum over four excitations",
        &[
            "physical_least_instructions",
            "physical_mean_instructions",
            "physical_most_instructions",
        ],
    ),
    (
        "first step after a reset",
        &["physical_first_step_instructions"],
    ),
    (
        "step whose input is NaN and held",
        &["physical_held_input_instructions"],
    ),
    (
        "step whose input is limited to the maximum rate",
        &["physical_limited_input_instructions"],
    ),
    (
        "step whose input is too far away, under force",
        &["physical_jumped_input_instructions"],
    ),
    (
        "step that meets another damper's state",
        &["physical_swapped_damper_instructions"],
    ),
    (
        "a step of the reduced damper",
        &["reduced_most_instructions"],
    ),
    ("bank of 12 in one call", &["bank_most_instructions"]),
    (
        "largest slice of loading a damper",
        &["load_slice_instructions"],
    ),
    ("C: `dashpot_step`", &["c_step_instructions"]),
    (
        "C: `dashpot_step_bank` of 12",
        &["c_step_bank_instructions"],
    ),
    (
        "C: `dashpot_damper_set_clearance`",
        &["c_set_clearance_instructions"],
    ),
    ("C: `dashpot_damper_init`", &["c_damper_init_instructions"]),
    (
        "C: `dashpot_check_slice`, maximum over a round",
        &["c_check_slice_instructions"],
    ),
    (
        "portable C: minimum and maximum of a step",
        &[
            "standalone_least_instructions",
            "standalone_most_instructions",
        ],
    ),
    (
        "portable C: first, held, limited, carried over to another clearance",
        &[
            "standalone_first_step_instructions",
            "standalone_held_input_instructions",
            "standalone_limited_input_instructions",
            "standalone_swapped_damper_instructions",
        ],
    ),
    (
        "portable C: a step divided by the core's, %",
        &["standalone_percent_of_the_core"],
    ),
    (
        "stack of a step, including the unusual ones above, bytes",
        &["stack_bytes"],
    ),
    (
        "code and constants of the C library without health and hybrid tests, bytes",
        &["code_and_constant_bytes"],
    ),
    (
        "what its health functions add, bytes",
        &["health_code_and_constant_bytes"],
    ),
    (
        "what its functions for hybrid tests add, bytes",
        &["hybrid_code_and_constant_bytes"],
    ),
    ("damper, bytes", &["damper_bytes"]),
    ("state, bytes", &["state_bytes"]),
    (
        "symbols of panic, heap, double precision in software",
        &["panic_symbols", "heap_symbols", "soft_double_symbols"],
    ),
];

/// The documents' tables, and the line in the README.
fn compare_documents(measured: &[(&Column, Figures)]) {
    let (second, first): (Vec<_>, Vec<_>) = measured
        .iter()
        .partition(|(column, _)| column.name == DISTRIBUTION);
    for (part, columns) in [("measured", first), ("measured by a distribution", second)] {
        let Some((column, figures)) = columns.first() else {
            continue;
        };
        let version = column
            .toolchain
            .version()
            .unwrap_or_else(|error| panic!("{error}"));
        // Another compiler must keep the budget, but its figures may differ.
        if !document::blessing() && !document::part(CONTRACT, part).contains(&version) {
            eprintln!("{CONTRACT} has the figures of another compiler than {version}");
            continue;
        }
        document::compare_part(CONTRACT, part, &table(&version, &columns));
        if part == "measured" {
            let figure = |name: &str| {
                let found = figures.iter().find(|(figure, _)| figure == name);
                found.map_or(f64::NAN, |(_, value)| *value)
            };
            let line = format!(
                "On a Cortex-M7 a step takes {} instructions ({version}), every step the same, {} bytes of stack and \
                 {} \
                 bytes of state.\n",
                figure("physical_most_instructions"),
                figure("stack_bytes"),
                figure("state_bytes"),
            );
            document::compare_part("README.md", "target", &line);
        }
    }
}

fn table(version: &str, columns: &[&(&Column, Figures)]) -> String {
    let mut text = format!("| {version} |");
    for (column, _) in columns {
        write!(text, " {} |", column.processor.title).expect("text grows");
    }
    write!(text, "\n|---{}|\n", "|---".repeat(columns.len())).expect("text grows");
    for (what, names) in ROWS {
        write!(text, "| {what} |").expect("text grows");
        for (_, figures) in columns {
            let value = |name: &&str| {
                let found = figures.iter().find(|(figure, _)| figure == name);
                found
                    .map_or(f64::NAN, |(_, value)| *value)
                    .round()
                    .to_string()
            };
            let values: Vec<String> = names.iter().map(value).collect();
            write!(text, " {} |", values.join(", ")).expect("text grows");
        }
        text.push('\n');
    }
    text
}
