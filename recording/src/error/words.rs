//! Parts of error texts.

use std::ops::RangeInclusive;

use crate::text_options::{DecimalMark, Separator};
use crate::unit::Quantity;

/// Maximum number of names that a message lists.
const MAX_NAMES: usize = 12;

/// Maximum length of a name in a message, in characters.
const MAX_NAME_CHARACTERS: usize = 40;

/// Returns a hint for a row with the wrong number of cells. Twice the expected number suggests decimal commas.
pub(super) fn decimal_comma(cells: u64, expected: u64, separator: Separator) -> String {
    if cells == 2 * expected && separator == Separator::Comma {
        "; if the numbers have a decimal comma, quote them or separate the cells by another character".into()
    } else {
        format!(" (separated by {})", separator.name())
    }
}

/// Describes a missing channel and lists the channels of the file.
pub(super) fn missing(quantity: Quantity, name: &str, numbered: bool, found: &[String]) -> String {
    if numbered {
        return format!("no header says which column is the {quantity}");
    }
    format!("column {name} is missing; the file has {}", listed(found))
}

/// Describes groups without common times.
pub(super) fn apart(
    displacement: &str,
    displacement_s: Option<&RangeInclusive<f64>>,
    force: &str,
    force_s: Option<&RangeInclusive<f64>>,
) -> String {
    let period = |period: Option<&RangeInclusive<f64>>| match period {
        Some(period) => format!("{} s to {} s", period.start(), period.end()),
        None => "no samples".into(),
    };
    format!(
        "no time of the displacement (group {displacement}: {}) is within the times of the force (group {force}: {}), \
         so no force can be interpolated",
        period(displacement_s),
        period(force_s)
    )
}

/// Lists the first names in quotes and counts the rest.
pub(super) fn listed(names: &[String]) -> String {
    let shown = |name: &String| {
        let start: String = name.chars().take(MAX_NAME_CHARACTERS).collect();
        format!("`{}`", start.escape_debug())
    };
    let mut text: Vec<String> = names.iter().take(MAX_NAMES).map(shown).collect();
    if let Some(more) = names.len().checked_sub(MAX_NAMES).filter(|more| *more > 0) {
        text.push(format!("{more} more"));
    }
    text.join(", ")
}

/// Lists groups with their numbers, from 1.
pub(super) fn numbered_list(names: &[String]) -> String {
    if names.is_empty() {
        return "none in this file".into();
    }
    let numbered = names.iter().take(MAX_NAMES).enumerate();
    let names: Vec<String> = numbered
        .map(|(number, name)| match name.as_str() {
            "" => (number + 1).to_string(),
            name => format!("{} `{name}`", number + 1),
        })
        .collect();
    names.join(", ")
}

/// Describes a file without usable rows.
pub(super) fn no_row(left_out: u64) -> String {
    match left_out {
        0 => "no row after the header".into(),
        count => format!(
            "no complete row after the header: {count} rows with missing values were omitted"
        ),
    }
}

/// Names a decimal mark.
pub(super) fn mark_name(mark: DecimalMark) -> &'static str {
    match mark {
        DecimalMark::Point => "point",
        DecimalMark::Comma => "comma",
    }
}
