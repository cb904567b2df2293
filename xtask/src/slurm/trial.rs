//! A study in a folder, its rows as one process computes them, and its shards.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::node::{Node, have_ended, wait_until};
use crate::run::{Outcome, repository};

/// Text of the study.
const STUDY: &str = include_str!("study.toml");

/// File of the study. The space tests the quoting in the files of `cluster/`.
pub const STUDY_FILE: &str = "a study.toml";

/// Number of cases of the study.
pub const CASES: u64 = 24;

/// Number of shards.
pub const SHARDS: u64 = 4;

/// A study, a Slurm cluster that runs it, and a folder for results.
pub struct Trial {
    /// Slurm cluster that runs the jobs.
    pub node: Node,
    /// Folder for the study, the results of each check, and Slurm's logs.
    pub folder: PathBuf,
    /// Rows from one process with one thread.
    whole: String,
}

impl Trial {
    /// Runs the study in one process, in an empty folder.
    ///
    /// # Errors
    /// The study fails.
    pub fn new(node: Node) -> Outcome<Self> {
        let folder = repository().join("target/slurm");
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
        }
        fs::create_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
        let study = folder.join(STUDY_FILE);
        fs::write(&study, STUDY).map_err(|error| in_file(&study, &error))?;
        let mut trial = Self {
            node,
            folder,
            whole: String::new(),
        };
        let options = ["sweep", STUDY_FILE, "--threads", "1", "--no-page"];
        trial.dashpot(&[&options[..], &["--output", "whole"]].concat(), 0)?;
        trial.whole = read(&trial.folder.join("whole/rows.csv"))?;
        match trial.whole.lines().count() {
            25 => Ok(trial),
            lines => Err(format!(
                "{lines} lines of rows, allowed: a header and {CASES}"
            )),
        }
    }

    /// Runs `dashpot`, which must end with this exit code, and returns its output.
    ///
    /// # Errors
    /// `dashpot` ends with another exit code.
    pub fn dashpot(&self, arguments: &[&str], code: i32) -> Outcome<String> {
        let mut command = Command::new(program());
        command.args(arguments).current_dir(&self.folder);
        let line = format!("dashpot {}", arguments.join(" "));
        let failed = |error| format!("cannot run `{line}`: {error}");
        let Output {
            status,
            stdout,
            stderr,
        } = command.output().map_err(failed)?;
        let text = [stdout, stderr].concat();
        let text = String::from_utf8_lossy(&text).into_owned();
        if status.code() == Some(code) {
            Ok(text)
        } else {
            Err(format!("`{line}`: {status}, allowed: {code}: {text}"))
        }
    }

    /// Creates a folder of results with the rows of these shards, copied from the results of the complete array.
    ///
    /// # Errors
    /// A file cannot be copied.
    pub fn results(&self, name: &str, shards: &[u64]) -> Outcome<PathBuf> {
        let folder = self.folder.join(name);
        fs::create_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
        for shard in shards {
            let from = self.folder.join(COMPLETE).join(rows_of(*shard));
            fs::copy(&from, folder.join(rows_of(*shard)))
                .map_err(|error| in_file(&from, &error))?;
        }
        Ok(folder)
    }

    /// Submits `cluster/slurm/study.sbatch` for some tasks of `shards`, and returns the job's ID.
    ///
    /// # Errors
    /// Slurm refuses the job.
    pub fn submit(&self, results: &str, tasks: &str, shards: u64) -> Outcome<String> {
        let options = [
            &format!("--array={tasks}"),
            "--cpus-per-task=1",
            "--mem-per-cpu=100M",
        ];
        let shards = shards.to_string();
        let path = path_with_dashpot()?;
        let variables = [
            ("STUDY", STUDY_FILE),
            ("SHARDS", &shards),
            ("OUTPUT", results),
            ("PATH", &path),
        ];
        let script = repository().join("cluster/slurm/study.sbatch");
        self.node
            .submit(&script, &options, &variables, &self.folder)
    }

    /// Submits tasks as [`Self::submit`] does and waits until each has ended in its expected state.
    ///
    /// # Errors
    /// A task ends in another state.
    pub fn run(
        &self,
        results: &str,
        tasks: &str,
        shards: u64,
        expected: &[&str],
    ) -> Outcome<String> {
        let job = self.submit(results, tasks, shards)?;
        self.has_ended(&job, expected)?;
        Ok(job)
    }

    /// Waits until each task of a job has ended in its expected state.
    ///
    /// # Errors
    /// A task ends in another state.
    pub fn has_ended(&self, job: &str, expected: &[&str]) -> Outcome {
        let states = self.node.ended(job)?;
        if states == expected {
            return Ok(());
        }
        Err(format!(
            "job {job}: {}, allowed: {}",
            states.join(", "),
            expected.join(", ")
        ))
    }

    /// Returns what a task printed.
    ///
    /// # Errors
    /// There is no log.
    pub fn log(&self, job: &str, task: u64) -> Outcome<String> {
        read(&self.folder.join(format!("dashpot-{job}_{task}.log")))
    }

    /// Waits until a shard that a job is running has at least one row.
    ///
    /// # Errors
    /// The job ends without a row.
    pub fn wait_for_a_row(&self, results: &str, job: &str, shard: u64) -> Outcome {
        wait_until(&format!("a row of shard {shard}"), || {
            let states = self.node.states(&format!("{job}_{shard}"))?;
            match self.rows_kept(results, shard) {
                0 if have_ended(&states) => Err(format!(
                    "shard {shard} ended without rows of {}: {}",
                    rows_of(shard),
                    self.log(job, shard)?.trim()
                )),
                0 => Ok(None),
                _ => Ok(Some(())),
            }
        })
    }

    /// Returns the number of rows of a shard that is not complete.
    pub fn rows_kept(&self, results: &str, shard: u64) -> u64 {
        let partial = format!("{}.partial", rows_of(shard));
        let text = fs::read_to_string(self.folder.join(results).join(partial));
        // The first line is the header.
        text.map_or(0, |text| {
            text.matches('\n').count().saturating_sub(1) as u64
        })
    }

    /// Merges a folder of results; the rows must equal those of one process.
    ///
    /// # Errors
    /// The rows differ.
    pub fn merges_to_the_whole(&self, results: &str) -> Outcome {
        self.merge(results, 0)?;
        let merged = self.folder.join(results).join("merged/rows.csv");
        if read(&merged)? == self.whole {
            return Ok(());
        }
        Err(format!(
            "{}: its rows differ from those of one process",
            merged.display()
        ))
    }

    /// Merges a folder of results; the merge must fail with this message.
    ///
    /// # Errors
    /// The merge succeeds, or its message differs.
    pub fn merge_fails(&self, results: &str, expected: &str) -> Outcome {
        let text = self.merge(results, 1)?;
        if self.folder.join(results).join("merged").exists() {
            return Err("merge failed but wrote a file".into());
        }
        contains(&text, expected)
    }

    fn merge(&self, results: &str, code: i32) -> Outcome<String> {
        let folder = self.folder.join(results);
        let entries = fs::read_dir(&folder).map_err(|error| in_file(&folder, &error))?;
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let rows = names.filter(|name| name.starts_with("rows-") && name.ends_with(".csv"));
        let mut rows: Vec<String> = rows.map(|name| format!("{results}/{name}")).collect();
        rows.sort();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let output = format!("{results}/merged");
        let merge = ["merge", STUDY_FILE, "--no-page", "--output", &output];
        self.dashpot(&[&merge[..], &rows].concat(), code)
    }
}

/// Folder with the results of the complete array.
pub const COMPLETE: &str = "complete";

/// Returns the name of the file with a shard's rows.
pub fn rows_of(shard: u64) -> String {
    format!("rows-{shard}-of-{SHARDS}.csv")
}

/// Checks that a text contains another.
pub fn contains(text: &str, expected: &str) -> Outcome {
    if text.contains(expected) {
        return Ok(());
    }
    Err(format!("`{}`, allowed: `{expected}`", text.trim()))
}

/// Reads a text file.
pub fn read(path: &Path) -> Outcome<String> {
    fs::read_to_string(path).map_err(|error| in_file(path, &error))
}

/// Returns the message about a file.
pub fn in_file(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

fn program() -> PathBuf {
    repository().join("target/release/dashpot")
}

/// Returns the search path with the folder of the built `dashpot` first.
pub fn path_with_dashpot() -> Outcome<String> {
    let path = std::env::var("PATH").map_err(|error| format!("PATH: {error}"))?;
    let folder = repository().join("target/release");
    Ok(format!("{}:{path}", folder.display()))
}
