//! Ticks at which a report would grow take as many instructions as their neighbours. Valgrind's Callgrind runs this
//! test again, counts the instructions, and writes the counts between every two ticks of some windows.

use std::process::Command;

use xtask::tools::{VALGRIND, have};

use crate::driven;

/// Number of ticks: enough to enlarge and merge the curves of a page, and to complete a window of 5 s of the ride
/// indices.
const TICKS: u64 = 5200;

/// Middles of the windows of counted ticks: ticks at which a list doubles its capacity, the curves of a page are
/// merged, or a window of 5 s of the ride indices ends.
const WINDOWS: [u64; 5] = [512, 1024, 2048, 4096, 5000];

/// Number of counted ticks before the middle of a window, and from the middle on.
const AROUND: u64 = 4;

/// Maximum ratio of the count of a tick to the median. Counts differ because flange contact adds patches and one tick
/// replaces a damper.
const MAX_OVER_MEDIAN: f64 = 1.5;

/// Environment variable set in the process under Valgrind.
const IS_COUNTED: &str = "DASHPOT_TICKS_ARE_COUNTED";

/// `CALLGRIND_DUMP_STATS`, the first request of the tool with the letters C and T: writes the counts since the last
/// request.
const DUMP_STATS: u64 = 0x4354_0000;

/// `CALLGRIND_START_INSTRUMENTATION` and `CALLGRIND_STOP_INSTRUMENTATION`: Valgrind is faster while it does not count.
const START: u64 = 0x4354_0004;
const STOP: u64 = 0x4354_0005;

/// Sends a request to Callgrind. Without Valgrind it has no effect: the instructions rotate a register by 128 bits in
/// total and exchange another register with itself.
fn request(request: u64) {
    let request = [request, 0, 0, 0, 0, 0];
    // SAFETY: Valgrind reads the six numbers and returns its answer in rdx.
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

/// True if the counts are written before this tick; they are those of the previous tick.
fn is_counted(tick: u64) -> bool {
    let mut windows = WINDOWS.iter();
    windows.any(|middle| (middle - AROUND + 1..=middle + AROUND).contains(&tick))
}

/// Runs under Valgrind; does nothing otherwise.
#[test]
fn counted() {
    if std::env::var_os(IS_COUNTED).is_some() {
        let mut tick = 0;
        driven(TICKS, || {
            // Called before each tick.
            if WINDOWS.iter().any(|middle| tick == middle - AROUND) {
                request(START);
            }
            if is_counted(tick) {
                request(DUMP_STATS);
            }
            if WINDOWS.iter().any(|middle| tick == middle + AROUND) {
                request(STOP);
            }
            tick += 1;
        });
    }
}

#[test]
fn all_ticks_take_about_the_same_number_of_instructions() {
    if !have(&[VALGRIND], "instructions of each tick") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // The contact tables are computed and cached outside Valgrind.
    driven(1, || {});
    let counts = folder.path().join("counts");
    let output = Command::new(VALGRIND.program)
        .args([
            "--tool=callgrind",
            "--combine-dumps=yes",
            "--instr-atstart=no",
        ])
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
    // The last summary is written when the program ends and contains no ticks.
    let ticks: Vec<u64> = (0..TICKS).filter(|tick| is_counted(*tick)).collect();
    assert_eq!(counts.len(), ticks.len() + 1, "{error}");
    // The first count after a start is too small: it lacks the instructions counted before the last stop.
    let (ticks, counts): (Vec<u64>, Vec<u64>) = ticks
        .into_iter()
        .zip(counts)
        .filter(|(tick, _)| WINDOWS.iter().all(|middle| *tick != middle - AROUND + 1))
        .unzip();
    assert_eq!(counts.len() as u64, (2 * AROUND - 1) * WINDOWS.len() as u64);
    let mut sorted = counts.to_vec();
    sorted.sort_unstable();
    let median = sorted[sorted.len() / 2];
    assert!(median > 10_000, "the count is of a tick: {median}");
    println!(
        "median {median}, least {}, most {}",
        sorted[0],
        sorted[sorted.len() - 1]
    );
    let limit = (MAX_OVER_MEDIAN * median as f64) as u64;
    let beyond: Vec<_> = counts
        .iter()
        .zip(ticks.iter().map(|tick| tick - 1))
        .filter(|(count, _)| **count > limit)
        .collect();
    assert!(
        beyond.is_empty(),
        "median {median}, allowed {limit}, by tick: {beyond:?}"
    );
}
