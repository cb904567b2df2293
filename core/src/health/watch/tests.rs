//! Averages and doubts against numbers computed by hand, most of them exact in single precision.

use super::super::filter::{FLOW, Filter, LAG, Prepared, STATES};
use super::super::model::{Baseline, HealthLimits, HealthModel};
use super::super::reading::HealthStatus;
use super::Watch;

mod alarms;

/// Limits: flow 0.5, compliance half of 0.25 m/N, clearance 0.5 m, force offset 8 N; all changes must exceed two
/// deviations for more than three measured blocks.
fn model() -> HealthModel {
    HealthModel {
        alarm_blocks: 3,
        start: [1.0, 0.25, 0.5, 2.0],
        start_variance: [1.0, 1.0, 1.0, 4.0, 1.0, 1.0],
        zero_limit_n: 8.0,
        baseline: Baseline::new(1.0, 0.25, 1.0),
        limits: HealthLimits {
            flow_factor: 0.5,
            compliance: 0.5,
            clearance_m: 0.5,
            deviations: 2.0,
        },
        ..HealthModel::EMPTY
    }
}

const HEALTHY: [f32; STATES] = [0.0, 1.0, 0.25, 0.5, 2.0, 0.0, 0.0];

fn started() -> Watch {
    let mut watch = Watch::EMPTY;
    watch.begin();
    watch
}

/// Compares as often as an alarm needs.
fn status(watch: &mut Watch, model: &HealthModel, filter: &Filter) -> HealthStatus {
    let mut status = HealthStatus::empty();
    for _ in 0..=model.alarm_blocks {
        status = compared(watch, model, filter, true, status);
    }
    status
}

fn compared(
    watch: &mut Watch,
    model: &HealthModel,
    filter: &Filter,
    measured: bool,
    status: HealthStatus,
) -> HealthStatus {
    watch.compare_first(model, filter, measured);
    watch.compare_second(model, filter, measured, false, status)
}

/// The healthy state with one state and its variance changed.
fn changed(row: usize, value: f32, variance: f32) -> Filter {
    let mut filter = Filter::new(HEALTHY, [0.0; STATES]);
    filter.state[row] = value;
    filter.diagonal[row] = variance;
    filter
}

#[test]
fn squared_innovations_are_averaged_over_128_blocks_and_bounded_by_nine() {
    let mut watch = started();
    assert_eq!(watch.average_square(5.0), 5.0);
    assert_eq!(watch.scatter, 1.0 + 4.0 / 128.0);
    let mut watch = started();
    assert_eq!(watch.average_square(800.0), 9.0);
    assert_eq!(watch.scatter, 1.0 + 8.0 / 128.0);
    let mut watch = started();
    assert_eq!(watch.average_square(0.0), 0.0);
    assert_eq!(watch.scatter, 1.0 - 1.0 / 128.0);
}

#[test]
fn successive_innovations_are_multiplied_and_bounded_by_three() {
    for (second, average) in [
        (0.5, 2.0 * 0.5 / 4.0 / 128.0),
        (-0.5, -2.0 * 0.5 / 4.0 / 128.0),
        (100.0, 3.0 / 128.0),
        (-100.0, -3.0 / 128.0),
    ] {
        let mut watch = started();
        let mut prepared = Prepared::NONE;
        prepared.variance = 4.0;
        prepared.innovation = 2.0;
        watch.correlate(&prepared);
        assert_eq!(watch.correlation, 0.0);
        prepared.innovation = second;
        watch.correlate(&prepared);
        assert_eq!(watch.correlation, average);
        // An innovation of 0 follows: the average decays.
        prepared.innovation = 0.0;
        watch.correlate(&prepared);
        assert_eq!(watch.correlation, average * (127.0 / 128.0));
    }
}

#[test]
fn deviations_grow_with_scatter_and_with_correlation_above_chance() {
    for (scatter, correlation, scale) in [
        (1.0, 0.0, 1.0),
        (0.5, 0.0, 1.0),
        (2.0, 0.0, 2.0),
        (2.0, 0.1, 2.0),
        (2.0, -3.0, 2.0),
        (2.0, 1.1, 8.0),
        (0.5, 0.6, 3.5),
    ] {
        let watch = Watch {
            scatter,
            correlation,
            ..started()
        };
        let error = (watch.scale() - scale).abs();
        assert!(error < 1e-6, "{scatter}, {correlation}: {}", watch.scale());
    }
}

#[test]
fn a_healthy_damper_has_no_status() {
    let filter = Filter::new(HEALTHY, [0.0; STATES]);
    let found = status(&mut started(), &model(), &filter);
    assert_eq!(found, HealthStatus::empty());
}

#[test]
fn a_lag_one_and_a_half_prior_deviations_from_the_prior_is_late() {
    // Prior 2 s with a deviation of 2 s.
    for (lag_s, is_late) in [(5.0, false), (5.125, true), (-1.0, false), (-1.125, true)] {
        let filter = changed(LAG, lag_s, 0.0);
        let found = status(&mut started(), &model(), &filter);
        assert_eq!(found.contains(HealthStatus::LATE), is_late, "{lag_s} s");
    }
}

#[test]
fn a_misfit_begins_above_a_correlation_of_a_half_and_ends_at_a_fifth() {
    let model = model();
    let filter = Filter::new(HEALTHY, [0.0; STATES]);
    let (none, misfit) = (HealthStatus::empty(), HealthStatus::MISFIT);
    for (correlation, before, after) in [
        (0.5, none, none),
        (0.51, none, misfit),
        (0.21, misfit, misfit),
        (0.2, misfit, none),
        (0.3, none, none),
    ] {
        let mut watch = Watch {
            correlation,
            ..started()
        };
        assert_eq!(compared(&mut watch, &model, &filter, true, before), after);
    }
}

#[test]
fn a_latched_alarm_remains_while_its_cause_is_found_again() {
    let model = model();
    let beyond = changed(FLOW, 2.0, 0.0);
    let mut watch = started();
    let mut found = status(&mut watch, &model, &beyond);
    for _ in 0..3 {
        assert_eq!(found, HealthStatus::FLOW);
        found = compared(&mut watch, &model, &beyond, true, found);
    }
}

#[test]
fn a_missing_force_is_latched() {
    let model = model();
    let filter = Filter::new(HEALTHY, [0.0; STATES]);
    let mut watch = started();
    let none = HealthStatus::empty();
    let found = watch.compare_second(&model, &filter, true, true, none);
    assert_eq!(found, HealthStatus::NO_FORCE);
    assert_eq!(compared(&mut watch, &model, &filter, true, found), found);
}
