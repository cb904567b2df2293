//! Time of the parts of `replay` for each file format, compared with the step alone in the same run: reading, reading
//! with ticks and step, and all of it with output in the same format.
//!
//! One element is a row, which is also a tick. The difference between a replay and the step alone is the cost of
//! reading and writing.

use std::hint::black_box;
use std::io;
use std::path::{Path, PathBuf};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use dashpot_core::Damper;
use dashpot_files::FileError;
use dashpot_files::damper;
use dashpot_recording::Recording;
use dashpot_recording::tick_grid::{Tick, TickGrid};
use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_testbench::replay::replay;

const ROWS: u32 = 100_000;
const STEP_S: f64 = 1e-3;

const FORMS: [(&str, FileFormat); 3] = [
    ("CSV", FileFormat::Text),
    ("MDF4", FileFormat::Mdf4),
    ("Parquet", FileFormat::Parquet),
];

const TIME: Column = Column::new("time_s", "s");
const DISPLACEMENT: Column = Column::new("displacement_m", "m");
const FORCE: Column = Column::new("force_n", "N");

/// Time (s) and displacement (m) of a row, with the digits of a logger.
fn row(number: u32) -> [f64; 2] {
    let time_s = f64::from(number) / 1e3;
    let x = 1e-2 * (8.8 * time_s).sin() + 2e-3 * (31.1 * time_s).sin();
    [time_s, (x * 1e8).round() / 1e8]
}

fn recording(folder: &Path, form: FileFormat) -> PathBuf {
    let path = folder.join("recording");
    let mut file = std::fs::File::create(&path).expect("a temporary file");
    let mut rows =
        RowWriter::new(&path, &mut file, form, &[TIME, DISPLACEMENT]).expect("a temporary file");
    for values in (0..ROWS).map(row) {
        rows.row(&values, values).expect("a temporary file");
    }
    rows.finish().expect("a temporary file");
    path
}

fn open(path: &Path) -> TickGrid {
    let recording = Recording::open(path).expect("a recording");
    TickGrid::new(recording, STEP_S).expect("a row")
}

fn of(
    group: &mut BenchmarkGroup<'_, WallTime>,
    damper: &Damper<f32>,
    (name, form): (&str, FileFormat),
) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = recording(folder.path(), form);
    group.bench_function(format!("{name}: read"), |bencher| {
        bencher.iter(|| {
            let mut recording = Recording::open(&path).expect("a recording");
            while let Some(sample) = recording.next_sample().expect("a row") {
                black_box(sample);
            }
        });
    });
    group.bench_function(format!("{name}: replay"), |bencher| {
        bencher.iter(|| {
            replay(damper, &mut open(&path), None, |_, force, _| {
                black_box(force);
                Ok::<_, FileError>(())
            })
            .expect("a row")
        });
    });
    group.bench_function(format!("{name}: replay, written"), |bencher| {
        bencher.iter(|| {
            let mut sink = io::sink();
            let columns = [TIME, DISPLACEMENT, FORCE];
            let mut rows = RowWriter::new(&path, &mut sink, form, &columns).expect("no file");
            let summary = replay(damper, &mut open(&path), None, |tick: Tick, force, _| {
                let values = [tick.time_s, tick.displacement_m, f64::from(force)];
                rows.row(&values, (tick.time_s, tick.displacement_m, force))
            });
            rows.finish().expect("no file");
            summary.expect("a row")
        });
    });
}

fn replays(criterion: &mut Criterion) {
    let parameters = damper::load("in-service", &[]).expect("a preset");
    let damper: Damper<f32> = parameters.build(STEP_S).expect("a preset");
    let mut group = criterion.benchmark_group("replay, a row");
    group.throughput(Throughput::Elements(u64::from(ROWS)));
    group.bench_function("step alone", |bencher| {
        let motion: Vec<f32> = (0..ROWS).map(|number| row(number)[1] as f32).collect();
        bencher.iter(|| {
            let mut state = damper.at_rest(motion[0]);
            for &x in &motion {
                black_box(damper.step(&mut state, black_box(x)));
            }
        });
    });
    for form in FORMS {
        of(&mut group, &damper, form);
    }
    group.finish();
}

criterion_group!(benches, replays);
criterion_main!(benches);
