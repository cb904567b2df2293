//! Replay by parts, per row: reading the recording alone, with the tick grid, with the step.

use std::hint::black_box;
use std::io::Cursor;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dashpot_core::Damper;
use dashpot_hil::files::FileError;
use dashpot_hil::files::damper;
use dashpot_hil::files::recording::Recording;
use dashpot_hil::study::replay::replay;
use dashpot_hil::study::tick_grid::TickGrid;

const ROWS: u32 = 100_000;
const STEP_S: f64 = 1e-3;

fn text() -> Vec<u8> {
    let mut text = String::from("time_s,displacement_m\n");
    for row in 0..ROWS {
        let time_s = f64::from(row) * STEP_S;
        let x = 1e-2 * (8.8 * time_s).sin() + 2e-3 * (31.1 * time_s).sin();
        text.push_str(&format!("{time_s:.6},{x:.8}\n"));
    }
    text.into_bytes()
}

fn replays(criterion: &mut Criterion) {
    let text = text();
    let open = || {
        let source = Box::new(Cursor::new(text.clone()));
        Recording::read(Path::new("bench.csv"), source).expect("a recording")
    };
    let parameters = damper::load("in-service", &[]).expect("a preset");
    let damper: Damper<f32> = parameters.build(STEP_S).expect("a preset");
    let mut group = criterion.benchmark_group("replay, a row");
    group.throughput(Throughput::Elements(u64::from(ROWS)));
    group.bench_function("read", |bencher| {
        bencher.iter(|| {
            let mut recording = open();
            while let Some(sample) = recording.next_sample().expect("a row") {
                black_box(sample);
            }
        });
    });
    group.bench_function("read, ticks", |bencher| {
        bencher.iter(|| {
            let mut ticks = TickGrid::new(open(), STEP_S).expect("a row");
            while let Some(tick) = ticks.next_tick().expect("a row") {
                black_box(tick);
            }
        });
    });
    group.bench_function("read, ticks, step", |bencher| {
        bencher.iter(|| {
            let mut ticks = TickGrid::new(open(), STEP_S).expect("a row");
            replay(&damper, &mut ticks, None, |_, force, _| {
                black_box(force);
                Ok::<_, FileError>(())
            })
            .expect("a row")
        });
    });
    group.finish();
}

criterion_group!(benches, replays);
criterion_main!(benches);
