//! Runs programs in the repository's folder and reports which one failed.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Result of a command; the error is a message for the developer.
pub type Outcome<T = ()> = Result<T, String>;

/// Runs cargo and shows its output.
pub fn cargo(arguments: &[&str]) -> Outcome {
    cargo_with(arguments, &[])
}

/// Runs cargo with environment variables and shows its output.
pub fn cargo_with(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    show(arguments, variables, Stdio::inherit())
}

/// Runs cargo with environment variables and sends all of its output to standard error, which keeps standard output
/// free for a result.
pub fn cargo_output_to_stderr(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    show(arguments, variables, std::io::stderr().into())
}

fn show(arguments: &[&str], variables: &[(&str, &str)], output: Stdio) -> Outcome {
    let mut command = cargo_command(arguments);
    command.envs(variables.iter().copied()).stdout(output);
    run(command, &format!("cargo {}", arguments.join(" ")))
}

/// Runs a program, shows its output and how long it took. Messages call it `line`.
pub fn run(mut command: Command, line: &str) -> Outcome {
    eprintln!("> {line}");
    let start = Instant::now();
    let status = command
        .status()
        .map_err(|error| format!("cannot run `{line}`: {error}"))?;
    eprintln!("> {line}: {:.0} s", start.elapsed().as_secs_f64());
    if status.success() {
        Ok(())
    } else {
        Err(format!("`{line}` failed: {status}"))
    }
}

/// Runs the cargo of another rustup toolchain in the repository's folder and shows its output.
pub fn cargo_of(toolchain: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let line = format!("cargo +{toolchain} {}", arguments.join(" "));
    let mut command = cargo_of_toolchain(toolchain);
    command.args(arguments).envs(variables.iter().copied());
    run(command, &line)
}

/// Returns the cargo of a rustup toolchain, to which the caller adds arguments.
pub fn cargo_of_toolchain(toolchain: &str) -> Command {
    let mut command = Command::new("cargo");
    command
        .arg(format!("+{toolchain}"))
        .current_dir(repository());
    // rustup sets these variables for the programs it starts, such as this one.
    for variable in ["CARGO", "RUSTC", "RUSTDOC", "RUSTUP_TOOLCHAIN"] {
        command.env_remove(variable);
    }
    command
}

/// Runs cargo and returns its standard output.
pub fn cargo_output(arguments: &[&str]) -> Outcome<String> {
    output_of(
        cargo_command(arguments),
        &format!("cargo {}", arguments.join(" ")),
    )
}

/// Runs a program and returns the first word of its output that starts with a digit, such as the version in
/// `rustc --version`. A leading `valgrind-` counts as a separate word.
pub fn version_of(program: &str, arguments: &[&str]) -> Outcome<String> {
    let mut command = Command::new(program);
    command.args(arguments);
    let line = format!("{program} {}", arguments.join(" "));
    let text = output_of(command, &line)?;
    text.trim()
        .split([' ', '\n'])
        .map(|word| word.strip_prefix("valgrind-").unwrap_or(word))
        .find(|word| word.starts_with(|first: char| first.is_ascii_digit()))
        .map(str::to_owned)
        .ok_or_else(|| format!("`{line}` printed no version: `{}`", text.trim()))
}

/// Runs a program and returns its standard output.
pub fn output_of(mut command: Command, line: &str) -> Outcome<String> {
    let output = command
        .output()
        .map_err(|error| format!("cannot run `{line}`: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!(
            "`{line}` failed: {}\n{}",
            output.status,
            String::from_utf8_lossy(&output.stderr)
        ))
    }
}

/// Runs git in the repository and returns its standard output.
pub fn git(arguments: &[&str]) -> Outcome<String> {
    let mut git = Command::new("git");
    git.args(arguments).current_dir(repository());
    output_of(git, &format!("git {}", arguments.join(" ")))
}

/// Returns cargo with these arguments, in the repository.
pub fn cargo_command(arguments: &[&str]) -> Command {
    // Use the cargo that runs this program, or `cargo` if the program was started by hand.
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments).current_dir(repository());
    command
}

/// Returns the repository's folder.
pub fn repository() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}
