//! Memory that a replay takes: as much for a long recording as for a short one, whatever form it is read from and written to.

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

/// More than three windows of MDF4 (4 MiB) and twelve row groups of Parquet have.
const FEW: usize = 800_000;
const MANY: usize = 2 * FEW;

/// Bytes of a row of time and displacement.
const ROW: usize = 16;

const COLUMNS: [Column; 3] = [
    Column::new("time_s", "s"),
    Column::new("displacement_m", "m"),
    Column::new("force_n", "N"),
];

const MIB: usize = 1 << 20;

/// Heap in use, and the most that there was (bytes).
static IN_USE: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

/// The system's allocator, its bytes counted.
struct Counting;

// SAFETY: every call is handed to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let in_use = IN_USE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(in_use, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most heap that `run` has in use beyond what was before (bytes).
fn most_of(run: impl FnOnce()) -> usize {
    let before = IN_USE.load(Ordering::Relaxed);
    MOST.store(before, Ordering::Relaxed);
    run();
    MOST.load(Ordering::Relaxed) - before
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

/// As the command does, all but the file that is written.
fn replayed(path: &Path, form: FileFormat, rows: usize) {
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

/// One test, for what others use at the same time would be counted too.
#[test]
fn a_replay_takes_as_much_memory_for_a_long_recording_as_for_a_short_one() {
    for (form, most) in [
        (FileFormat::Text, MIB),
        (FileFormat::Parquet, 8 * MIB),
        (FileFormat::Mdf4, 16 * MIB),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let [few, many] = [FEW, MANY].map(|rows| {
            let path = recording(folder.path(), form, rows);
            most_of(|| replayed(&path, form, rows))
        });
        assert!(many < most, "{form:?}: {many}");
        // A list of row groups or blocks is kept, which is far from a byte a row.
        let growth = many.saturating_sub(few);
        assert!(8 * growth < MANY - FEW, "{form:?}: {few} {many}");
        // The count sees rows that are held.
        let path = folder.path().join("recording");
        let held = most_of(|| {
            let rows = Recording::open(&path).unwrap().read_all().unwrap();
            assert_eq!(rows.len(), MANY);
        });
        assert!(held > MANY * ROW, "{form:?}: {held}");
    }
}
