//! Name of the exported constant, and the command line that repeats the export.

use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use dashpot_export::constant_name;

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
