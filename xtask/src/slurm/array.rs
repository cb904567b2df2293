//! Checks of a Slurm array of shards, undisturbed and disturbed.

use super::trial::{CASES, COMPLETE, SHARDS, Trial, contains, read, rows_of};
use crate::run::Outcome;

/// Runs all shards at once.
pub fn complete(trial: &Trial) -> Outcome<String> {
    trial.run(COMPLETE, "0-3", SHARDS, &["COMPLETED"; 4])?;
    trial.merges_to_the_whole(COMPLETE)?;
    Ok("the same bytes".into())
}

const ENDED: &str = "ended";

/// Ends shard 1 with scancel's SIGTERM, and shard 2 with SIGKILL, as if a node had gone down.
pub fn ended(trial: &Trial) -> Outcome<String> {
    trial.results(ENDED, &[0, 3])?;
    let job = trial.submit(ENDED, "1-2", SHARDS)?;
    for shard in [1, 2] {
        trial.wait_for_a_row(ENDED, &job, shard)?;
    }
    trial.node.run("scancel", &[&format!("{job}_1")])?;
    trial.node.run(
        "scancel",
        &["--batch", "--signal=KILL", &format!("{job}_2")],
    )?;
    trial.has_ended(&job, &["CANCELLED", "FAILED"])?;
    // The command stopped in an orderly way.
    contains(
        &trial.log(&job, 1)?,
        "of 6 cases are done; the same command resumes",
    )?;
    let expected = missing(&[1, 2]);
    trial.merge_fails(ENDED, &expected)?;
    let kept = [1, 2].map(|shard| trial.rows_kept(ENDED, shard));
    Ok(format!(
        "exit code 1, `{expected}`; rows kept: {} and {}",
        kept[0], kept[1]
    ))
}

/// Resubmits the shards that [`ended`] left incomplete.
pub fn resumed(trial: &Trial) -> Outcome<String> {
    let kept = [1, 2].map(|shard| (shard, trial.rows_kept(ENDED, shard)));
    let job = trial.run(ENDED, "1-2", SHARDS, &["COMPLETED"; 2])?;
    let mut run = Vec::new();
    for (shard, kept) in kept {
        run.push(resumes(trial, &job, shard, kept)?);
    }
    trial.merges_to_the_whole(ENDED)?;
    Ok(format!(
        "6 cases per shard: {} and {} ran now; the same bytes",
        run[0], run[1]
    ))
}

/// Requeues a shard with `scontrol requeue`, as happens if a node goes down or another job takes precedence.
pub fn requeued(trial: &Trial) -> Outcome<String> {
    let results = "requeued";
    trial.results(results, &[1, 2, 3])?;
    let job = trial.submit(results, "0", SHARDS)?;
    trial.wait_for_a_row(results, &job, 0)?;
    trial
        .node
        .run("scontrol", &["requeue", &format!("{job}_0")])?;
    trial.has_ended(&job, &["COMPLETED"])?;
    let log = trial.log(&job, 0)?;
    // The log contains both runs; the first run printed how many cases it had completed.
    let done = log
        .split("interrupted: ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let done = done.and_then(|word| word.parse().ok());
    let kept = done.ok_or_else(|| format!("the log shows no interruption: {log}"))?;
    let run = resumes(trial, &job, 0, kept)?;
    trial.merges_to_the_whole(results)?;
    Ok(format!(
        "6 cases: {kept} ran before the requeue and {run} after it; the same bytes"
    ))
}

/// Resubmits a shard that is complete.
pub fn complete_again(trial: &Trial) -> Outcome<String> {
    let results = "again";
    let rows = trial.results(results, &[0, 1, 2, 3])?.join(rows_of(2));
    let before = read(&rows)?;
    let job = trial.run(results, "2", SHARDS, &["COMPLETED"])?;
    contains(&trial.log(&job, 2)?, "6 cases, none run now")?;
    if read(&rows)? != before {
        return Err("the rows changed".into());
    }
    trial.merges_to_the_whole(results)?;
    Ok("`6 cases, none run now`".into())
}

/// Submits a shard twice; the second job is refused while the first runs.
pub fn twice_at_once(trial: &Trial) -> Outcome<String> {
    let results = "twice";
    trial.results(results, &[0, 2, 3])?;
    let first = trial.submit(results, "1", SHARDS)?;
    trial.wait_for_a_row(results, &first, 1)?;
    let second = trial.run(results, "1", SHARDS, &["FAILED"])?;
    let refusal = "another process is adding rows to it";
    contains(&trial.log(&second, 1)?, refusal)?;
    trial.has_ended(&first, &["COMPLETED"])?;
    contains(&trial.log(&first, 1)?, "6 cases, 6 run now")?;
    trial.merges_to_the_whole(results)?;
    Ok(format!("`{refusal}`; the same bytes"))
}

/// Runs shard 3 of 5 instead of shard 3 of 4.
pub fn wrong_count(trial: &Trial) -> Outcome<String> {
    let results = "count";
    trial.results(results, &[0, 1, 2])?;
    trial.run(results, "3", 5, &["COMPLETED"])?;
    // This shard has cases 3, 8, 13, 18 and 23 instead of 3, 7, 11, 15, 19 and 23.
    let doubles = [(0, "8"), (1, "13"), (2, "18")];
    let doubles = doubles.map(|(shard, cases)| {
        let files = format!("{results}/{} and {results}/rows-3-of-5.csv", rows_of(shard));
        format!("; duplicates in {files}: {cases}")
    });
    let missing = "4 of 24 cases are missing: 7, 11, 15, 19";
    trial.merge_fails(results, &format!("{missing}{}", doubles.concat()))?;
    Ok(format!(
        "exit code 1, `{missing}; duplicates in ...: 8; ...: 13; ...: 18`"
    ))
}

/// Submits shard 4 of 4, which does not exist: shards are numbered 0 to 3.
pub fn beyond(trial: &Trial) -> Outcome<String> {
    let job = trial.run("beyond", "4", SHARDS, &["FAILED"])?;
    let refusal = "--shard 4: allowed with --shards 4: 0 to 3";
    contains(&trial.log(&job, 4)?, refusal)?;
    Ok(format!("`{refusal}`"))
}

/// Checks that a shard of six cases ran only those without rows, and returns their number.
fn resumes(trial: &Trial, job: &str, shard: u64, kept: u64) -> Outcome<u64> {
    let all = CASES / SHARDS;
    if kept == 0 || kept >= all {
        return Err(format!(
            "shard {shard} had {kept} rows, allowed: 1 to {}",
            all - 1
        ));
    }
    let run = all - kept;
    contains(
        &trial.log(job, shard)?,
        &format!("{all} cases, {run} run now"),
    )?;
    Ok(run)
}

/// Returns merge's message when only these two neighbouring shards are missing.
fn missing(shards: &[u64; 2]) -> String {
    let [first, last] = shards;
    let ranges = (0..CASES).step_by(SHARDS as usize);
    let ranges = ranges.map(|start| format!("{}-{}", start + first, start + last));
    let ranges: Vec<String> = ranges.collect();
    format!("12 of {CASES} cases are missing: {}", ranges.join(", "))
}
