//! A wrapper of rustc that records the processor time of each run.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};

use super::unit::Unit;
use crate::run::{Outcome, repository};

/// Environment variable that names the file for records. If it is set, this program acts as a wrapper of rustc.
pub const LOG: &str = "DASHPOT_COMPILER_LOG";

/// Ticks per second in which Linux reports processor time to programs; the same on all platforms that we build on.
const TICKS_PER_S: f64 = 100.0;

/// Runs the compiler named by the first argument, with the other arguments, records its processor time, and returns its
/// exit code.
pub fn compile(arguments: &[String]) -> ExitCode {
    match compile_and_record(arguments) {
        Ok(code) => code,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn compile_and_record(arguments: &[String]) -> Outcome<ExitCode> {
    let [compiler, arguments @ ..] = arguments else {
        return Err(format!(
            "{LOG} is set, but cargo did not start this program"
        ));
    };
    let status = Command::new(compiler).args(arguments).status();
    let status = status.map_err(|error| format!("cannot run {compiler}: {error}"))?;
    if let Some(unit) = Unit::from_arguments(arguments) {
        record(unit, child_processor_seconds()?)?;
    }
    // A compiler that a signal ended has no exit code.
    Ok(status
        .code()
        .and_then(|code| u8::try_from(code).ok())
        .map_or(ExitCode::FAILURE, ExitCode::from))
}

/// Completes a unit from the variables that cargo sets, and appends it to the log.
fn record(mut unit: Unit, processor_s: f64) -> Outcome {
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    unit.package = format!(
        "{} {}",
        variable("CARGO_PKG_NAME"),
        variable("CARGO_PKG_VERSION")
    );
    unit.is_ours = Path::new(&variable("CARGO_MANIFEST_DIR")).starts_with(repository());
    unit.needs_build_script = !unit.is_build_script && !variable("OUT_DIR").is_empty();
    unit.processor_s = processor_s;
    let log = variable(LOG);
    let failed = |error: std::io::Error| format!("{log}: {error}");
    // A single write keeps the lines of compilers that end at the same time apart.
    let line = unit.line() + "\n";
    let file = fs::File::options().create(true).append(true).open(&log);
    file.and_then(|mut file| file.write_all(line.as_bytes()))
        .map_err(failed)
}

/// Processor time, user and system, of the programs for which this one has waited and of their children, in seconds.
///
/// # Errors
/// This is not Linux.
pub fn child_processor_seconds() -> Outcome<f64> {
    let stat = fs::read_to_string("/proc/self/stat").map_err(|error| {
        format!("processor time is measured on Linux only: /proc/self/stat: {error}")
    })?;
    child_ticks(&stat)
        .map(|ticks| ticks as f64 / TICKS_PER_S)
        .ok_or_else(|| format!("/proc/self/stat has no processor time: {stat}"))
}

/// Sum of `cutime` and `cstime`, fields 16 and 17 of proc(5).
fn child_ticks(stat: &str) -> Option<u64> {
    // The second field is the program's name in parentheses, which may have spaces.
    let (_, rest) = stat.rsplit_once(')')?;
    let mut fields = rest.split_whitespace().skip(13);
    let user: u64 = fields.next()?.parse().ok()?;
    let system: u64 = fields.next()?.parse().ok()?;
    Some(user + system)
}

#[cfg(test)]
mod tests {
    use super::child_ticks;

    #[test]
    fn time_of_child_processes_is_read() {
        let stat = "27 (a) b) S 1 27 27 0 -1 4194560 1 2 3 4 10 20 300 45 20 0 1 0 5 6 7";
        assert_eq!(child_ticks(stat), Some(345));
        assert_eq!(child_ticks("27 (a) S 1"), None);
    }
}
