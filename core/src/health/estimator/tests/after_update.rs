//! Stages after the update of the filter: missing force, alarms, forgetting and restarts.

use super::super::super::block::Block;
use super::super::super::filter::{CLEARANCE, FLOW, Filter, LAG, STATES, ZERO};
use super::super::super::model::HealthModel;
use super::super::super::reading::HealthStatus;
use super::super::{Health, MAX_OUTLIERS, stage};
use super::model;

/// An estimate with unit variances. Its ends moved by 1 m at constant force if `has_moved`.
fn idle(model: &HealthModel, unmeasured: u32, has_moved: bool) -> Health {
    let mut health = Health::new(model);
    health.filter = Filter::new([0.0; STATES], [1.0; STATES]);
    health.unmeasured = unmeasured;
    for position in [0.0, if has_moved { 1.0 } else { 0.0 }] {
        let block = Block {
            position,
            ..Block::NONE
        };
        health.follow.take(model, &block, [1.0, 0.25], false);
    }
    health
}

/// Does one stage in a tick.
fn work(health: &mut Health, model: &HealthModel, stage: u32) {
    health.stage = stage;
    health.gathered.ticks_left = 8;
    health.tick(model, 0.0, 0.0);
}

#[test]
fn forgetting_increases_the_variances_up_to_their_initial_values() {
    let mut model = model();
    model.start_variance[ZERO - 1] = 1.5;
    let mut health = idle(&model, 0, false);
    health.forgetting = 4.0;
    health.forget(&model);
    // 1 + 0.25 * 4 for the parameters, 1 + 0.0625 * 4 for the lag.
    let expected = [1.0, 2.0, 2.0, 2.0, 1.25, 1.5, 2.0];
    assert_eq!(health.filter.diagonal, expected);
    assert_eq!(health.stage, stage::DONE);
    // Nothing more is forgotten until the next measurement.
    health.forget(&model);
    assert_eq!(health.filter.diagonal, expected);
}

#[test]
fn the_lag_is_forgotten_like_the_rest_while_the_estimate_converges() {
    let model = model();
    let mut health = idle(&model, 0, false);
    // Large innovations of the same sign in a row.
    health.prepared.innovation = 2.0;
    health.prepared.variance = 1.0;
    for _ in 0..100 {
        health.watch.correlate(&health.prepared);
    }
    health.forgetting = 4.0;
    health.forget(&model);
    assert_eq!(health.filter.diagonal, [1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0]);
}

#[test]
fn only_a_long_motion_without_contact_makes_the_estimate_outdated() {
    let model = model();
    for (unmeasured, has_moved, factor) in [
        (62, true, 1.0),
        (63, true, 1.25),
        (1000, true, 1.25),
        (63, false, 1.0),
        (0, true, 1.0),
        (0, false, 1.0),
    ] {
        let mut health = idle(&model, unmeasured, has_moved);
        health.forget(&model);
        assert_eq!(
            health.filter.diagonal[FLOW], factor,
            "{unmeasured}, {has_moved}"
        );
    }
}

#[test]
fn the_thirteenth_outlier_in_a_row_restarts_the_estimate() {
    let model = model();
    let mut health = idle(&model, 0, false);
    health.samples = 7;
    for number in 1..=MAX_OUTLIERS {
        work(&mut health, &model, stage::LEAVE_OUT);
        assert_eq!((health.outliers, health.stage), (number, stage::FOLLOW));
        // An outlier forgets 25 times as much as a usual block.
        assert_eq!(health.forgetting, 25.0);
    }
    assert_eq!(health.filter.diagonal, [1.0; STATES]);
    assert!(!health.status().contains(HealthStatus::RESTARTED));
    health.leave_out(&model);
    assert!(health.status().contains(HealthStatus::RESTARTED));
    assert_eq!(health.filter, Health::new(&model).filter);
    assert_eq!((health.outliers, health.samples), (0, 7));
}

#[test]
fn a_damaged_estimate_restarts_at_once() {
    let model = model();
    for (number, variance) in [(f32::NAN, 1.0), (f32::INFINITY, 1.0), (0.0, f32::NAN)] {
        let mut health = idle(&model, 0, false);
        health.filter.state[LAG] = number;
        health.prepared.variance = variance;
        health.leave_out(&model);
        assert!(health.status().contains(HealthStatus::RESTARTED));
        assert_eq!(health.filter, Health::new(&model).filter);
    }
}

#[test]
fn without_recent_contact_a_smaller_move_shows_that_the_force_is_missing() {
    let model = model();
    // The clearance is 0.5 m, and no more than 2 m (0.5 mm without contact) may be added to it. The ends move 1 m.
    for (unmeasured, is_missing) in [(0, false), (62, false), (63, true), (1000, true)] {
        let mut health = idle(&model, unmeasured, true);
        health.filter.state[CLEARANCE] = 0.25;
        for _ in 0..3 {
            assert!(!health.follow.is_missing());
            work(&mut health, &model, stage::FOLLOW);
            assert_eq!(health.stage, stage::COMPARE_FIRST);
        }
        assert_eq!(health.follow.is_missing(), is_missing, "{unmeasured}");
    }
}

#[test]
fn only_measured_blocks_count_towards_an_alarm() {
    let model = model();
    // Flow factor 2 instead of 1, clearance 2.5 m instead of 0.5 m; the rest as in the baseline.
    let state = [0.0, 2.0, 0.5, 1.25, 0.0, 0.0, 0.0];
    let alarms = HealthStatus::FLOW | HealthStatus::CLEARANCE;
    for (unmeasured, expected) in [(0, alarms), (1, HealthStatus::empty())] {
        let mut health = Health::new(&model);
        health.filter = Filter::new(state, [0.0; STATES]);
        health.unmeasured = unmeasured;
        for _ in 0..=model.alarm_blocks {
            let latched = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
            assert!(!health.status().intersects(latched));
            work(&mut health, &model, stage::COMPARE_FIRST);
            work(&mut health, &model, stage::COMPARE_SECOND);
            assert_eq!(health.stage, stage::FORGET);
        }
        assert_eq!(health.status() & alarms, expected, "{unmeasured}");
        assert!(health.status().contains(HealthStatus::SEVERAL_CHANGED));
    }
}
