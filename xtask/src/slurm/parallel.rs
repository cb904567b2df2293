//! Checks of shards that GNU parallel runs.

use std::fs;
use std::process::Command;

use super::trial::{SHARDS, STUDY_FILE, Trial, in_file, path_with_dashpot, read, rows_of};
use crate::run::{Outcome, repository};

const RESULTS: &str = "parallel";

/// Runs all shards, but shard 2 cannot write its rows; then repeats the command, which must run only this shard.
pub fn one_failed(trial: &Trial) -> Outcome<String> {
    let results = trial.results(RESULTS, &[])?;
    let barrier = results.join(format!("{}.partial", rows_of(2)));
    fs::create_dir(&barrier).map_err(|error| in_file(&barrier, &error))?;
    if run(trial)? {
        return Err("parallel succeeded although a shard failed".into());
    }
    fs::remove_dir(&barrier).map_err(|error| in_file(&barrier, &error))?;
    if !run(trial)? {
        return Err("parallel failed again".into());
    }
    let log = results.join(format!("jobs-of-{SHARDS}.log"));
    let runs = runs(&read(&log)?)?;
    if runs.len() != 5 || runs[..4].iter().filter(|(_, failed)| *failed).count() != 1 {
        return Err(format!("shards that ran, true if failed: {runs:?}"));
    }
    if runs[4] != (2, false) {
        return Err(format!(
            "shard that ran again, true if failed: {:?}",
            runs[4]
        ));
    }
    trial.merges_to_the_whole(RESULTS)?;
    Ok("5 runs of shards; the same bytes".into())
}

/// Runs `cluster/parallel/study.sh` and returns true if it succeeds.
fn run(trial: &Trial) -> Outcome<bool> {
    let mut script = Command::new("sh");
    script.arg(repository().join("cluster/parallel/study.sh"));
    script
        .env("STUDY", STUDY_FILE)
        .env("SHARDS", SHARDS.to_string());
    script
        .env("OUTPUT", RESULTS)
        .env("JOBS", "2")
        .env("THREADS", "1");
    script
        .env("PATH", path_with_dashpot()?)
        .current_dir(&trial.folder);
    let output = script.output().map_err(|error| format!("sh: {error}"))?;
    Ok(output.status.success())
}

/// Reads parallel's log: the shards in the order in which they ended, each with `true` if it failed.
fn runs(log: &str) -> Outcome<Vec<(u64, bool)>> {
    let run = |line: &str| {
        let columns: Vec<&str> = line.split('\t').collect();
        let job: u64 = columns.first()?.parse().ok()?;
        // Jobs are numbered from 1; the seventh column is the exit code.
        Some((job.checked_sub(1)?, *columns.get(6)? != "0"))
    };
    let runs: Option<Vec<(u64, bool)>> = log.lines().skip(1).map(run).collect();
    runs.ok_or_else(|| format!("this is not a log of parallel: {log}"))
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn a_log_of_parallel_is_read() {
        let log = "Seq\tHost\tStarttime\tJobRuntime\tSend\tReceive\tExitval\tSignal\tCommand\n\
                   2\t:\t1.0\t     0.1\t0\t5\t1\t0\tdashpot sweep\n\
                   1\t:\t1.0\t     2.1\t0\t5\t0\t0\tdashpot sweep\n";
        assert_eq!(runs(log), Ok(vec![(1, true), (0, false)]));
        assert!(runs("Seq\n1\t:\n").is_err());
    }
}
