//! Name of the exported constant, and the command line that repeats the export.

use std::path::Path;

use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::input::is_standard_stream;

/// Returns the name of the constant, by default ending in `end`; `None` for bytes only.
pub(super) fn name_of(arguments: &ExportArguments, end: &str) -> Outcome<Option<String>> {
    match (&arguments.name, arguments.lang) {
        (None, Language::Bin) => Ok(None),
        (Some(name), Language::Bin) => Err(Failure::wrong_use(format!(
            "--name {name}: bytes have no name; allowed: --lang rust or c"
        ))),
        (Some(name), _) => Ok(Some(name.clone())),
        (None, _) => Ok(Some(constant_name(&arguments.damper.damper) + end)),
    }
}

/// Returns the command line with all defaults written out.
pub(super) fn command_line(arguments: &ExportArguments, name: &str) -> String {
    let mut line = format!("dashpot export --damper '{}'", arguments.damper.damper);
    for assignment in &arguments.damper.overrides {
        line.push_str(&format!(" --set '{assignment}'"));
    }
    let standalone = if arguments.standalone {
        " --standalone"
    } else {
        ""
    };
    line.push_str(&format!(
        " --lang {}{standalone} --step-us {} --scalar {} --name {name} --output '{}'",
        arguments.lang.name(),
        arguments.step_us,
        arguments.scalar,
        arguments.output.display()
    ));
    line
}

/// Derives a constant name: MY_DAMPER for `data/my-damper.toml`, DAMPER for standard input.
pub(super) fn constant_name(damper: &str) -> String {
    if is_standard_stream(Path::new(damper)) {
        return "DAMPER".into();
    }
    let stem = Path::new(damper)
        .file_stem()
        .map_or_else(|| damper.into(), |stem| stem.to_string_lossy());
    let name: String = stem
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_uppercase()
            } else {
                '_'
            }
        })
        .collect();
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        name
    } else {
        format!("DAMPER_{name}")
    }
}
