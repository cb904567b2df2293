//! A study in a folder, its rows by one process, and shards of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::node::{Node, have_ended, wait_until};
use crate::run::{Outcome, repository};

/// The study.
const STUDY: &str = include_str!("study.toml");

/// Its file, with a space: what the files of `cluster/` start has to bear it.
pub const STUDY_FILE: &str = "a study.toml";

/// Its cases.
pub const CASES: u64 = 24;

/// Shards that it is run in.
pub const SHARDS: u64 = 4;

/// What is checked.
pub struct Trial {
    /// Slurm.
    pub node: Node,
    /// With the study, a folder of results a check, and Slurm's logs.
    pub folder: PathBuf,
    /// Rows by one process on one thread.
    whole: String,
}

impl Trial {
    /// Runs the study in one process, in a folder that is made anew.
    ///
    /// # Errors
    /// It fails.
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

    /// Runs `dashpot`, which must end with this code; what it prints.
    ///
    /// # Errors
    /// It ends with another.
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

    /// A folder of results with the rows of these shards, from that of `complete`.
    ///
    /// # Errors
    /// They are not there.
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

    /// Gives `cluster/slurm/study.sbatch` to Slurm for some tasks of so many shards; the job's number.
    ///
    /// # Errors
    /// It is refused.
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

    /// As [`Self::submit`]; waits for the end, which must be this of each task.
    ///
    /// # Errors
    /// A task ends otherwise.
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

    /// Waits for the end of a job, which must be this of each task.
    ///
    /// # Errors
    /// A task ends otherwise.
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

    /// What a task printed.
    ///
    /// # Errors
    /// There is no log.
    pub fn log(&self, job: &str, task: u64) -> Outcome<String> {
        read(&self.folder.join(format!("dashpot-{job}_{task}.log")))
    }

    /// Waits until a shard that a job is running has at least one row.
    ///
    /// # Errors
    /// It ends without.
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

    /// Rows of a shard that is not complete.
    pub fn rows_kept(&self, results: &str, shard: u64) -> u64 {
        let partial = format!("{}.partial", rows_of(shard));
        let text = fs::read_to_string(self.folder.join(results).join(partial));
        // The first line is the header.
        text.map_or(0, |text| {
            text.matches('\n').count().saturating_sub(1) as u64
        })
    }

    /// Merges what the folder of results has; it must be the rows of one process.
    ///
    /// # Errors
    /// It is not.
    pub fn merges_to_the_whole(&self, results: &str) -> Outcome {
        self.merge(results, 0)?;
        let merged = self.folder.join(results).join("merged/rows.csv");
        if read(&merged)? == self.whole {
            return Ok(());
        }
        Err(format!("{}: not the rows of one process", merged.display()))
    }

    /// Merges what the folder of results has, which must fail and say this.
    ///
    /// # Errors
    /// It does not.
    pub fn merge_says(&self, results: &str, expected: &str) -> Outcome {
        let text = self.merge(results, 1)?;
        if self.folder.join(results).join("merged").exists() {
            return Err("merge failed and wrote something".into());
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

/// The folder of results of the first check.
pub const COMPLETE: &str = "complete";

/// The file of a shard's rows.
pub fn rows_of(shard: u64) -> String {
    format!("rows-{shard}-of-{SHARDS}.csv")
}

/// Fails where the text does not have this.
pub fn contains(text: &str, expected: &str) -> Outcome {
    if text.contains(expected) {
        return Ok(());
    }
    Err(format!("`{}`, allowed: `{expected}`", text.trim()))
}

/// The text of a file.
pub fn read(path: &Path) -> Outcome<String> {
    fs::read_to_string(path).map_err(|error| in_file(path, &error))
}

/// What is wrong with a file.
pub fn in_file(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

fn program() -> PathBuf {
    repository().join("target/release/dashpot")
}

/// The path of programs with the `dashpot` that was built before all others.
pub fn path_with_dashpot() -> Outcome<String> {
    let path = std::env::var("PATH").map_err(|error| format!("PATH: {error}"))?;
    let folder = repository().join("target/release");
    Ok(format!("{}:{path}", folder.display()))
}
