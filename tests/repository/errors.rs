//! docs/reference/errors.md lists every error code and every status bit of the C header, with its number.

use std::collections::BTreeSet;

use dashpot::document::read;

const PAGE: &str = "docs/reference/errors.md";

/// Numbers and names of the header that begin with `prefix`: definitions and values of an enumeration. `part` shortens
/// each name.
fn in_header(prefix: &str, part: &str) -> BTreeSet<(u32, String)> {
    let header = read("capi/include/dashpot.h");
    let lines = header
        .lines()
        .map(|line| line.trim().trim_start_matches("#define "));
    let values = lines
        .filter(|line| line.starts_with(prefix))
        .filter_map(|line| {
            let (name, value) = line.split_once(" = ").or_else(|| line.split_once(' '))?;
            let value = value.trim_end_matches(',').parse().ok()?;
            Some((value, name.trim_start_matches(part).to_owned()))
        });
    values.collect()
}

/// The first two cells of each row below a heading: number and name.
fn on_page(heading: &str) -> BTreeSet<(u32, String)> {
    let page = read(PAGE);
    let heading = format!("## {heading}\n");
    let (_, section) = page
        .split_once(&heading)
        .unwrap_or_else(|| panic!("{PAGE}: no {heading}"));
    let section = section.split("\n## ").next().expect("a section");
    let rows = section.lines().filter_map(|line| {
        let mut cells = line
            .split('|')
            .skip(1)
            .map(|cell| cell.trim().trim_matches('`'));
        Some((cells.next()?.parse().ok()?, cells.next()?.to_owned()))
    });
    rows.collect()
}

#[test]
fn the_page_lists_the_codes_of_the_header_and_no_others() {
    for (heading, prefix, part, least) in [
        ("Error codes in C", "DASHPOT_ERROR_", "", 20),
        (
            "Status bits of the step",
            "DASHPOT_STATUS_",
            "DASHPOT_STATUS_",
            6,
        ),
        (
            "Status bits of a hybrid test",
            "DASHPOT_HYBRID_",
            "DASHPOT_HYBRID_",
            12,
        ),
    ] {
        let codes = in_header(prefix, part);
        // A search that finds no codes must fail.
        assert!(codes.len() >= least, "{prefix}: {codes:?}");
        assert_eq!(on_page(heading), codes, "{PAGE}, {heading}");
    }
}
