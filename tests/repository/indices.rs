//! docs/reference/indices.md lists the indices of a study, a bench test and a replay. A test of the crate
//! `dashpot-vehicle-run` compares it with the indices of a run.

use std::collections::BTreeSet;

use dashpot::document;
use dashpot_files::sheet::Index;
use dashpot_study::sweep::OBSERVED;

const PAGE: &str = "docs/reference/indices.md";

/// Source of the report of a replay.
const REPLAY: &str = "hil-host/src/commands/replay/mod.rs";

/// Names in the first cells of the rows below a heading.
fn documented(heading: &str) -> BTreeSet<String> {
    let page = document::read(PAGE);
    let heading = format!("\n## {heading}\n");
    let (_, section) = page
        .split_once(&heading)
        .unwrap_or_else(|| panic!("{PAGE}: no {heading}"));
    let section = section.split("\n## ").next().expect("a section");
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `"));
    let cells = rows.filter_map(|row| row.split(" |").next());
    let names = cells.flat_map(|cell| cell.trim_end_matches('`').split("`, `"));
    names.map(str::to_owned).collect()
}

#[test]
fn the_page_lists_the_indices_of_a_study() {
    let rows = OBSERVED.map(|index| format!("| `{}` | {} |\n", index.name, index.meaning));
    let table = format!("| name | index |\n|---|---|\n{}", rows.concat());
    document::compare_part(PAGE, "observed", &table);
}

#[test]
fn the_page_lists_the_indices_of_a_bench_test() {
    let names = Index::ALL.map(|index| index.key().to_owned());
    assert_eq!(documented("Bench test"), BTreeSet::from(names));
}

/// Fields of the report, read from its source, because the command is in no library.
#[test]
fn the_page_lists_the_report_of_a_replay() {
    let source = document::read(REPLAY);
    let (_, report) = source
        .split_once("\nstruct Report {\n")
        .expect("the report");
    let report = report.split("\n}").next().expect("the report");
    let fields = report.lines().filter_map(|line| {
        let (name, _) = line.trim().split_once(": ")?;
        let is_name = name
            .chars()
            .all(|letter| letter.is_ascii_lowercase() || "_0123456789".contains(letter));
        is_name.then(|| name.to_owned())
    });
    assert_eq!(documented("Replay"), fields.collect());
}
