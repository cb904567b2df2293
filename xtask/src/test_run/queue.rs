//! Runs test programs, two at a time: most of them end with a few long tests, which leave processors idle.

use std::collections::VecDeque;
use std::io::Write;
use std::sync::Mutex;
use std::time::Instant;

use super::programs::{Built, TestProgram};
use crate::run::Outcome;

/// Programs that run at once. Each runs as many tests at once as there are processors.
const AT_ONCE: usize = 2;

/// Runs all programs and prints the output of each at its end. Returns those that failed, with what failed in them.
///
/// # Errors
/// A program cannot be started.
pub(super) fn run_all(built: &Built, variables: &[(&str, &str)]) -> Outcome<Vec<String>> {
    let start = Instant::now();
    let waiting: Mutex<VecDeque<&TestProgram>> = Mutex::new(built.programs.iter().collect());
    let failures = Mutex::new(Vec::new());
    let work = || -> Outcome {
        loop {
            let next = waiting.lock().map_err(|_| "a thread failed")?.pop_front();
            let Some(program) = next else {
                return Ok(());
            };
            if let Some(failure) = run(built, program, variables)? {
                failures
                    .lock()
                    .map_err(|_| "a thread failed")?
                    .push(failure);
            }
        }
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..AT_ONCE).map(|_| scope.spawn(work)).collect();
        threads.into_iter().try_for_each(|thread| {
            let done = thread.join();
            done.unwrap_or_else(|_| Err("a thread failed".into()))
        })
    })?;
    eprintln!(
        "> {} test programs: {:.0} s",
        built.programs.len(),
        start.elapsed().as_secs_f64()
    );
    failures.into_inner().map_err(|_| "a thread failed".into())
}

/// Runs a program; returns what failed, if anything did.
fn run(
    built: &Built,
    program: &TestProgram,
    variables: &[(&str, &str)],
) -> Outcome<Option<String>> {
    let start = Instant::now();
    let mut command = built.command(program);
    let output = command
        .envs(variables.iter().copied())
        .output()
        .map_err(|error| format!("cannot run the tests of `{}`: {error}", program.name))?;
    let mut out = std::io::stdout().lock();
    let seconds = start.elapsed().as_secs_f64();
    // Without a reader of the output, the results still count.
    let _ = writeln!(out, "\n> tests of {}: {seconds:.0} s", program.name)
        .and_then(|()| out.write_all(&output.stdout))
        .and_then(|()| out.write_all(&output.stderr))
        .and_then(|()| out.flush());
    let failed = !output.status.success();
    Ok(failed.then(|| {
        let name = &program.name;
        let said = failures_in(&String::from_utf8_lossy(&output.stdout));
        format!("the tests of `{name}` failed{said}")
    }))
}

/// Returns the messages of failed tests from the output of a test program.
fn failures_in(output: &str) -> String {
    match output.split_once("\nfailures:\n") {
        Some((_, failures)) => format!(":\n{}", failures.trim()),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::failures_in;

    #[test]
    fn the_end_of_a_run_repeats_the_messages_of_failed_tests() {
        let output = "test a ... FAILED\n\nfailures:\n\n---- a stdout ----\nleft: 1\n\n\nfailures:\n    a\n\n";
        assert_eq!(
            failures_in(output),
            ":\n---- a stdout ----\nleft: 1\n\n\nfailures:\n    a"
        );
        assert_eq!(failures_in("signal: 6, SIGABRT"), "");
    }
}
