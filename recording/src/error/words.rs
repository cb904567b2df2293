//! Parts of the texts of errors.

use super::super::text::Separator;
use super::super::unit::Quantity;

/// Names of channels that a message lists at most.
const MOST_NAMES: usize = 12;

/// A hint for rows with twice the cells.
pub(super) fn decimal_comma(cells: u64, expected: u64, separator: Separator) -> String {
    if cells == 2 * expected && separator == Separator::Comma {
        "; numbers with a decimal comma have twice the cells where commas separate them too: accepted are such numbers in \
         quotes or behind another separator"
            .into()
    } else {
        format!(" (separated by {})", separator.name())
    }
}

/// That a channel is not there, and which there are.
pub(super) fn missing(quantity: Quantity, name: &str, numbered: bool, found: &[String]) -> String {
    if numbered {
        return format!("no header says which column is the {quantity}");
    }
    format!("column {name} is missing; there are {}", listed(found))
}

/// Names in quotes, those beyond the first few counted.
pub(super) fn listed(names: &[String]) -> String {
    let shown = |name: &String| {
        let start: String = name.chars().take(40).collect();
        format!("`{}`", start.escape_debug())
    };
    let mut text: Vec<String> = names.iter().take(MOST_NAMES).map(shown).collect();
    if let Some(more) = names.len().checked_sub(MOST_NAMES).filter(|more| *more > 0) {
        text.push(format!("{more} more"));
    }
    text.join(", ")
}

/// Groups with their numbers, from 1.
pub(super) fn numbered_list(names: &[String]) -> String {
    if names.is_empty() {
        return "none in this file".into();
    }
    let numbered = names.iter().take(MOST_NAMES).enumerate();
    let names: Vec<String> = numbered
        .map(|(number, name)| match name.as_str() {
            "" => (number + 1).to_string(),
            name => format!("{} `{name}`", number + 1),
        })
        .collect();
    names.join(", ")
}
