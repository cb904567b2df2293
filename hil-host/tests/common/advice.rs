//! Follows the advice of an error message as a user would: options in backticks after `use` are added or replaced,
//! those after `remove` are removed.

/// Options that take no value.
const SWITCHES: [&str; 4] = [
    "--reverse-force",
    "--reverse-displacement",
    "--no-skew",
    "--no-priors",
];

/// Returns each command line that the message `text` advises instead of `line`; there must be at least one.
pub fn advised(line: &[String], text: &str) -> Vec<Vec<String>> {
    let said: Vec<&str> = text
        .split(", or ")
        .filter(|part| part.contains('`'))
        .collect();
    let lines: Vec<_> = said
        .iter()
        .filter_map(|part| changed(line.to_vec(), part))
        .collect();
    assert!(!lines.is_empty(), "no advice in: {text}");
    lines
}

/// Applies the advice `part` to the command line `line`.
fn changed(line: Vec<String>, part: &str) -> Option<Vec<String>> {
    let used = part
        .split_once("use `")
        .and_then(|(_, rest)| rest.split_once('`'));
    let left = part.split_once("remove `").map(|(_, rest)| rest);
    if used.is_none() && left.is_none() {
        return None;
    }
    let mut line = line;
    for left in left.iter().flat_map(|left| left.split("` and `")) {
        line = without(line, left.split('`').next().unwrap_or_default());
    }
    let mut words = used.map_or("", |(options, _)| options).split_whitespace();
    while let Some(option) = words.next() {
        if SWITCHES.contains(&option) {
            line.push(option.into());
            continue;
        }
        let value = words
            .next()
            .unwrap_or_else(|| panic!("{option} without a value: {part}"));
        line = match option {
            "--vary" | "--prior" | "--hold" => without(line, &format!("{option} {}", key(value))),
            "--set" => line,
            _ => without(line, &format!("every {option}")),
        };
        line.extend([option.to_owned(), value.to_owned()]);
    }
    Some(line)
}

fn key(value: &str) -> &str {
    value.split('=').next().unwrap_or(value)
}

/// Removes `--option`, `--option KEY` or `every [other] --option` from `line`.
fn without(line: Vec<String>, what: &str) -> Vec<String> {
    let what = what
        .trim_start_matches("every ")
        .trim_start_matches("other ");
    let (option, of) = what
        .split_once(' ')
        .map_or((what, None), |(option, of)| (option, Some(of)));
    let mut kept = Vec::new();
    let mut words = line.into_iter();
    while let Some(word) = words.next() {
        if word != option {
            kept.push(word);
            continue;
        }
        if SWITCHES.contains(&option) {
            continue;
        }
        let value = words.next().unwrap_or_default();
        if of.is_some_and(|of| key(&value) != of) {
            kept.extend([word, value]);
        }
    }
    kept
}
