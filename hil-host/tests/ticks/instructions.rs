//! Every tick takes about as many instructions as its neighbours: counted by Valgrind's Callgrind, which runs this test again and writes
//! its counts between every two ticks.

use std::process::Command;

use xtask::tools::{VALGRIND, have};

use crate::driven;

/// Past the ticks at which the envelopes of a page grow and fold, and past a window of 5 s of the ride indices.
const TICKS: u64 = 5200;

/// Greatest count of a tick over the median: flange contact adds patches, and a new damper is met once.
const MAX_OVER_MEDIAN: f64 = 1.5;

/// Set in the process under Valgrind.
const IS_COUNTED: &str = "DASHPOT_TICKS_ARE_COUNTED";

/// `CALLGRIND_DUMP_STATS`: the first request of a tool whose letters are C and T.
const DUMP_STATS: u64 = 0x4354_0000;

/// Has Callgrind write what it counted since the last time, and start from zero. Nothing happens without Valgrind: the instructions of a
/// request rotate a register by 128 bits in all and exchange another with itself.
fn dump_counts() {
    let request = [DUMP_STATS, 0, 0, 0, 0, 0];
    // SAFETY: Valgrind reads the six numbers; rdx has its answer.
    unsafe {
        std::arch::asm!(
            "rol rdi, 3",
            "rol rdi, 13",
            "rol rdi, 61",
            "rol rdi, 51",
            "xchg rbx, rbx",
            in("rax") request.as_ptr(),
            inout("rdx") 0_u64 => _,
            out("rdi") _,
        );
    }
}

/// What runs under Valgrind; nothing by itself.
#[test]
fn counted() {
    if std::env::var_os(IS_COUNTED).is_some() {
        driven(TICKS, dump_counts);
        dump_counts();
    }
}

#[test]
fn no_tick_takes_many_more_instructions_than_the_others() {
    if !have(&[VALGRIND], "instructions of each tick") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // The tables of the contact are computed and kept without Valgrind.
    driven(1, || {});
    let counts = folder.path().join("counts");
    let output = Command::new(VALGRIND.program)
        .args(["--tool=callgrind", "--combine-dumps=yes", "--quiet"])
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "instructions::counted", "--test-threads=1"])
        .env(IS_COUNTED, "1")
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}", VALGRIND.program));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let text = std::fs::read_to_string(&counts).unwrap();
    let counts: Vec<u64> = text
        .lines()
        .filter_map(|line| line.strip_prefix("summary: ")?.trim().parse().ok())
        .collect();
    // Before the first tick, each tick, and what follows the last.
    assert_eq!(counts.len() as u64, TICKS + 2, "{error}");
    let ticks = &counts[1..=TICKS as usize];
    // The last one ends with the run.
    let ticks = &ticks[..ticks.len() - 1];
    let mut sorted = ticks.to_vec();
    sorted.sort_unstable();
    let median = sorted[sorted.len() / 2];
    assert!(median > 10_000, "the count is of a tick: {median}");
    let limit = (MAX_OVER_MEDIAN * median as f64) as u64;
    let beyond: Vec<_> = ticks
        .iter()
        .enumerate()
        .filter(|(_, count)| **count > limit)
        .collect();
    assert!(
        beyond.is_empty(),
        "median {median}, allowed {limit}, by tick: {beyond:?}"
    );
}
