//! A replay of a long recording takes no more memory than one of a short recording, in any format.

use std::alloc::{GlobalAlloc, Layout, System};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::Damper;
use dashpot_files::FileError;
use dashpot_files::damper;
use dashpot_recording::Recording;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_testbench::replay::replay;

const STEP_S: f64 = 1e-3;

/// More rows than three MDF4 windows (4 MiB) or twelve Parquet row groups hold.
const FEW: usize = 800_000;
const MANY: usize = 2 * FEW;

/// Bytes per row of time and displacement.
const ROW: usize = 16;

const COLUMNS: [Column; 3] = [
    Column::new("time_s", "s"),
    Column::new("displacement_m", "m"),
    Column::new("force_n", "N"),
];

const MIB: usize = 1 << 20;

/// Heap memory in use and its peak (bytes).
static IN_USE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

/// The system allocator with a count of its bytes.
struct Counting;

// SAFETY: every call is passed unchanged to the system allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let in_use = IN_USE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(in_use, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Returns the peak heap use of `run` beyond what was in use before (bytes).
fn peak_of(run: impl FnOnce()) -> usize {
    let before = IN_USE.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    run();
    PEAK.load(Ordering::Relaxed) - before
}

fn recording(folder: &Path, form: FileFormat, rows: usize) -> PathBuf {
    let path = folder.join("recording");
    let mut file = std::fs::File::create(&path).unwrap();
    let mut written = RowWriter::new(&path, &mut file, form, &COLUMNS[..2]).unwrap();
    for row in 0..rows {
        let time_s = row as f64 / 1e3;
        let values = [time_s, 1e-2 * (8.8 * time_s).sin()];
        written.row(&values, values).unwrap();
    }
    written.finish().unwrap();
    path
}

/// Replays a file like the command, but writes no output.
fn replay_file(path: &Path, form: FileFormat, rows: usize) {
    let damper: Damper<f32> = damper::load("in-service", &[])
        .unwrap()
        .build(STEP_S)
        .unwrap();
    let mut ticks = TickGrid::new(Recording::open(path).unwrap(), STEP_S).unwrap();
    let mut sink = io::sink();
    let mut written = RowWriter::new(path, &mut sink, form, &COLUMNS).unwrap();
    let summary = replay(&damper, &mut ticks, None, |tick, force, _| {
        let values = [tick.time_s, tick.displacement_m, f64::from(force)];
        written.row(&values, values)
    });
    let summary: Result<_, FileError> = summary;
    assert_eq!(summary.unwrap().ticks, rows as u64);
    written.finish().unwrap();
}

/// This is the only test in the binary, because memory used by concurrent tests would be counted too.
#[test]
fn a_long_recording_takes_no_more_memory_than_a_short_one() {
    for (form, max) in [
        (FileFormat::Text, MIB),
        (FileFormat::Parquet, 8 * MIB),
        (FileFormat::Mdf4, 16 * MIB),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let [few, many] = [FEW, MANY].map(|rows| {
            let path = recording(folder.path(), form, rows);
            peak_of(|| replay_file(&path, form, rows))
        });
        assert!(many < max, "{form:?}: {many}");
        // The list of row groups or blocks may grow, but by much less than a byte per row.
        let growth = many.saturating_sub(few);
        assert!(8 * growth < MANY - FEW, "{form:?}: {few} {many}");
        // Checks the counter itself: it must count rows that are held in memory.
        let path = folder.path().join("recording");
        let held = peak_of(|| {
            let rows = Recording::open(&path).unwrap().read_all().unwrap();
            assert_eq!(rows.len(), MANY);
        });
        assert!(held > MANY * ROW, "{form:?}: {held}");
    }
}
