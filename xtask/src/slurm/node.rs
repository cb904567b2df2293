//! A Slurm cluster of one node, which runs as long as the checks.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::run::{Outcome, output_of, repository};

/// Longest wait for jobs.
const MAX_WAIT: Duration = Duration::from_secs(120);

/// Time between two checks of jobs.
const PAUSE: Duration = Duration::from_millis(100);

/// A Slurm cluster of one node. It stops when dropped, and when this process ends for any reason.
#[derive(Debug)]
pub struct Node {
    script: Child,
    folder: PathBuf,
}

impl Node {
    /// Starts Slurm with `xtask/slurm_node.sh` on free ports.
    ///
    /// # Errors
    /// A daemon does not start; its output is on standard error.
    pub fn start() -> Outcome<Self> {
        let name = format!("dashpot-slurm-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let failed = |error: std::io::Error| format!("cannot start Slurm: {error}");
        // Both ports are held at the same time, so they differ.
        let free = || TcpListener::bind((Ipv4Addr::LOCALHOST, 0));
        let ports = [free().map_err(failed)?, free().map_err(failed)?];
        let mut script = plain("sh");
        script
            .arg(repository().join("xtask/slurm_node.sh"))
            .arg(&folder);
        for port in &ports {
            let address = port.local_addr().map_err(failed)?;
            script.arg(address.port().to_string());
        }
        drop(ports);
        script.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut script = script.spawn().map_err(failed)?;
        let output = script.stdout.take();
        let node = Self { script, folder };
        let mut line = String::new();
        if let Some(output) = output {
            BufReader::new(output)
                .read_line(&mut line)
                .map_err(failed)?;
        }
        match line.trim_end() {
            "ready" => Ok(node),
            _ => Err("Slurm did not start; its output is above".into()),
        }
    }

    /// Stops jobs and daemons.
    ///
    /// # Errors
    /// A process or the folder remains.
    pub fn end(mut self) -> Outcome<String> {
        let folder = self.folder.clone();
        drop(self.script.stdin.take());
        let ended = self.script.wait().map_err(|error| error.to_string())?;
        if !ended.success() || folder.exists() {
            return Err(format!("{ended}; {} remains", folder.display()));
        }
        Ok("jobs, daemons and folder".into())
    }

    /// Returns one of Slurm's commands.
    pub fn command(&self, program: &str) -> Command {
        let mut command = plain(program);
        command.env("SLURM_CONF", self.folder.join("slurm.conf"));
        command
    }

    /// Submits a job script with options and variables, and returns the job's ID.
    ///
    /// # Errors
    /// Slurm refuses the job.
    pub fn submit(
        &self,
        script: &Path,
        options: &[&str],
        variables: &[(&str, &str)],
        folder: &Path,
    ) -> Outcome<String> {
        let mut sbatch = self.command("sbatch");
        sbatch.arg("--parsable").args(options).arg(script);
        sbatch.envs(variables.iter().copied()).current_dir(folder);
        Ok(output_of(sbatch, "sbatch")?.trim().to_owned())
    }

    /// Runs one of Slurm's commands and ignores its output.
    ///
    /// # Errors
    /// The command fails.
    pub fn run(&self, program: &str, arguments: &[&str]) -> Outcome {
        let mut command = self.command(program);
        command.args(arguments);
        output_of(command, &format!("{program} {}", arguments.join(" "))).map(|_| ())
    }

    /// Returns the state of each task of a job, or of one task.
    ///
    /// # Errors
    /// `squeue` fails, or its output is not a list of tasks and states.
    pub fn states(&self, job: &str) -> Outcome<BTreeMap<u64, String>> {
        let mut squeue = self.command("squeue");
        squeue.args(["--noheader", "--array", "--states=all", "--format=%K %T"]);
        squeue.args(["--jobs", job]);
        let text = output_of(squeue, "squeue")?;
        let tasks = text.lines().map(|line| {
            let (task, state) = line.trim().split_once(' ')?;
            Some((task.parse().ok()?, state.trim().to_owned()))
        });
        let tasks: Option<BTreeMap<u64, String>> = tasks.collect();
        tasks.ok_or_else(|| format!("squeue: no list of tasks and states: {text}"))
    }

    /// Waits for a job and returns the final state of each task, in the order of tasks.
    ///
    /// # Errors
    /// The job does not end in time.
    pub fn ended(&self, job: &str) -> Outcome<Vec<String>> {
        wait_until(&format!("job {job} to end"), || {
            let states = self.states(job)?;
            Ok(have_ended(&states).then(|| states.into_values().collect()))
        })
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        drop(self.script.stdin.take());
        let _ = self.script.wait();
    }
}

/// True if all of these tasks have ended.
pub fn have_ended(states: &BTreeMap<u64, String>) -> bool {
    states.values().all(|state| is_end(state))
}

/// True if a task in this state has ended.
fn is_end(state: &str) -> bool {
    let ends = [
        "COMPLETED",
        "FAILED",
        "CANCELLED",
        "TIMEOUT",
        "NODE_FAIL",
        "OUT_OF_MEMORY",
    ];
    ends.contains(&state)
}

/// Calls `check` until it returns a value, and returns that.
///
/// # Errors
/// `check` fails, or returns no value for two minutes.
pub fn wait_until<T>(what: &str, mut check: impl FnMut() -> Outcome<Option<T>>) -> Outcome<T> {
    let started = Instant::now();
    loop {
        if let Some(found) = check()? {
            return Ok(found);
        }
        if started.elapsed() > MAX_WAIT {
            return Err(format!("waited {} s for {what}", MAX_WAIT.as_secs()));
        }
        std::thread::sleep(PAUSE);
    }
}

/// Returns a command without the environment variables that another Slurm sets for its jobs and users.
fn plain(program: &str) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let prefixes = ["SLURM", "SBATCH_", "SCANCEL_", "SQUEUE_", "SINFO_"];
        if prefixes.iter().any(|prefix| text.starts_with(prefix)) {
            command.env_remove(&name);
        }
    }
    command
}

#[cfg(test)]
mod tests {
    use super::is_end;

    #[test]
    fn a_task_that_runs_again_has_not_ended() {
        for state in [
            "PENDING",
            "RUNNING",
            "COMPLETING",
            "REQUEUED",
            "CONFIGURING",
        ] {
            assert!(!is_end(state), "{state}");
        }
        assert!(is_end("COMPLETED") && is_end("CANCELLED") && is_end("FAILED"));
    }
}
