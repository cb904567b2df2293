//! Time of the work behind Figs. 12, 15 and 17 of the paper (`dashpot sweep paper`): a case of each kind with its
//! indices, the plan that finds identical cases, and the curves of the page from the file that keeps them.
//!
//! An element is a tick of a case, a case of the plan, or a value of a curve.
#![allow(missing_docs)] // criterion's macros

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dashpot_files::study::StudyParameters;
use dashpot_study::sweep::rows::Rows;
use dashpot_study::sweep::{Plan, RunError, Shared, Study, curves, row};

/// Runs the first case of a sweep; contact and track are built before.
fn case(criterion: &mut Criterion, study: &Study, name: &str) {
    let sweep = study.parameters.sweep(name).expect("a sweep of the paper");
    let number = study.numbers(sweep, 0).start;
    let shared = Shared::default();
    let run = || {
        let row = row(study, number, &shared, &|| false).expect("a shipped case runs");
        row.expect("a case of the study")
    };
    assert_eq!(run().ending, "completed");
    let built = study.build(&study.case(number).expect("a case of the study"));
    let built = built.expect("a shipped case");
    let mut group = criterion.benchmark_group("figures");
    group.sample_size(10);
    group.throughput(Throughput::Elements(
        (built.duration_s / built.step_s).round() as u64,
    ));
    group.bench_function(format!("case of Fig. {name}"), |bencher| {
        bencher.iter(|| black_box(run()));
    });
    group.finish();
}

fn plan(criterion: &mut Criterion, study: &Study) {
    let numbers: Vec<u64> = study.part(None).collect();
    let mut group = criterion.benchmark_group("figures");
    group.sample_size(10);
    group.throughput(Throughput::Elements(study.cases()));
    group.bench_function("plan", |bencher| {
        bencher.iter(|| {
            let plan = Plan::new(study, &numbers, 1).expect("shipped cases");
            black_box(plan.simulations())
        });
    });
    group.finish();
}

/// Reads the curves of the cases of one seed.
fn kept_curves(criterion: &mut Criterion, study: &Study) {
    let needed = study.needed_curves();
    let numbers: Vec<u64> = needed.keys().copied().collect();
    let plan = Plan::new(study, &numbers, dashpot_workers::threads()).expect("shipped cases");
    let (mut rows, mut all) = (Rows::new(), curves::Curves::new());
    let take = |computed: dashpot_study::sweep::Computed| {
        rows.insert(computed.row.case, computed.row);
        all.extend(computed.curves);
        Ok::<(), RunError>(())
    };
    plan.run(&Shared::default(), &needed, &|| false, take)
        .expect("shipped cases run");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("rows.curves");
    curves::write(study, &rows, &all, &path).expect("the folder can be written");
    let values: usize = all.values().map(|curve| curve.values.len()).sum();
    let mut group = criterion.benchmark_group("figures");
    group.sample_size(10);
    group.throughput(Throughput::Elements(values as u64));
    group.bench_function("kept curves", |bencher| {
        bencher.iter(|| {
            let kept = curves::read(study, &rows, &path);
            assert_eq!(kept.curves.len(), all.len());
        });
    });
    group.finish();
}

fn figures(criterion: &mut Criterion) {
    let paper = StudyParameters::load("paper").expect("the study ships");
    let study = Study::new(paper.with_seeds(1)).expect("the study is valid");
    case(criterion, &study, "12a");
    case(criterion, &study, "17a");
    plan(criterion, &study);
    kept_curves(criterion, &study);
}

criterion_group!(benches, figures);
criterion_main!(benches);
