//! Changes of the parameters and their limits.

use super::super::super::filter::{CLEARANCE, COMPLIANCE, FLOW, Filter, STATES, ZERO};
use super::super::super::model::Baseline;
use super::super::super::reading::HealthStatus;
use super::super::Watch;
use super::{HEALTHY, changed, compared, model, started, status};

#[test]
fn a_change_beyond_its_limit_in_either_direction_raises_its_own_alarm() {
    use HealthStatus as Status;
    // The half clearance changes by half as much as the clearance.
    for (row, reference, limit, alarm) in [
        (FLOW, 1.0, 0.5, Status::FLOW),
        (COMPLIANCE, 0.25, 0.125, Status::STIFFNESS),
        (CLEARANCE, 0.5, 0.25, Status::CLEARANCE),
        (ZERO, 0.0, 8.0, Status::FORCE_ZERO),
    ] {
        for sign in [1.0, -1.0] {
            let at = changed(row, reference + sign * limit, 0.0);
            assert_eq!(status(&mut started(), &model(), &at), Status::empty());
            let beyond = changed(row, reference + sign * 1.125 * limit, 0.0);
            assert_eq!(status(&mut started(), &model(), &beyond), alarm);
        }
    }
}

#[test]
fn a_change_within_two_deviations_of_estimate_and_baseline_is_no_alarm() {
    use HealthStatus as Status;
    type Set = fn(&mut Baseline, f32);
    let deviations: [(usize, f32, f32, Set, Status); 3] = [
        (FLOW, 2.0, 0.5, |b, sd| b.flow_factor_sd = sd, Status::FLOW),
        (
            COMPLIANCE,
            0.5,
            0.125,
            |b, sd| b.compliance_sd_m_per_n = sd,
            Status::STIFFNESS,
        ),
        (
            CLEARANCE,
            1.0,
            0.5,
            |b, sd| b.clearance_sd_m = sd,
            Status::CLEARANCE,
        ),
    ];
    for (row, value, sd, set_baseline, alarm) in deviations {
        // Twice the limit is exactly two deviations of the estimate; those of the half clearance count twice.
        let half = if row == CLEARANCE { 0.5 } else { 1.0 };
        let own = half * sd;
        let doubtful = changed(row, value, own * own);
        assert!(!status(&mut started(), &model(), &doubtful).intersects(alarm));
        let sure = changed(row, value, 0.9 * own * own);
        assert!(status(&mut started(), &model(), &sure).contains(alarm));
        // The same with the deviation of the baseline, and with a scatter of 2 on half the variance.
        let mut model = model();
        let known = changed(row, value, 0.0);
        set_baseline(&mut model.baseline, sd);
        assert!(!status(&mut started(), &model, &known).intersects(alarm));
        set_baseline(&mut model.baseline, 0.9 * sd);
        assert!(status(&mut started(), &model, &known).contains(alarm));
        set_baseline(&mut model.baseline, 0.0);
        let mut scattered = Watch {
            scatter: 2.0,
            ..started()
        };
        let doubtful = changed(row, value, 0.5 * own * own);
        assert!(!status(&mut scattered, &model, &doubtful).intersects(alarm));
    }
    for (variance, expected) in [(64.0, false), (57.0, true)] {
        let filter = changed(ZERO, 16.0, variance);
        let found = status(&mut started(), &model(), &filter);
        assert_eq!(found.contains(Status::FORCE_ZERO), expected);
    }
    let mut scattered = Watch {
        scatter: 2.0,
        ..started()
    };
    let filter = changed(ZERO, 16.0, 32.0);
    assert!(!status(&mut scattered, &model(), &filter).contains(Status::FORCE_ZERO));
}

#[test]
fn an_alarm_needs_consecutive_measured_blocks_and_a_settled_estimate() {
    let model = model();
    let none = HealthStatus::empty();
    let beyond = changed(FLOW, 2.0, 0.0);
    let healthy = changed(FLOW, 1.0, 0.0);
    let mut watch = started();
    for _ in 0..3 {
        assert_eq!(compared(&mut watch, &model, &beyond, true, none), none);
    }
    // Blocks without measurement do not count, but do not interrupt either.
    for _ in 0..10 {
        assert_eq!(compared(&mut watch, &model, &beyond, false, none), none);
    }
    let alarm = HealthStatus::FLOW;
    assert_eq!(compared(&mut watch, &model, &beyond, true, none), alarm);
    // A cleared alarm returns with the next measured block, not before.
    assert_eq!(compared(&mut watch, &model, &beyond, false, none), none);
    assert_eq!(compared(&mut watch, &model, &beyond, true, none), alarm);
    // The alarm is latched. One block within the limit starts the count again.
    assert_eq!(compared(&mut watch, &model, &healthy, true, alarm), alarm);
    for _ in 0..3 {
        assert_eq!(compared(&mut watch, &model, &beyond, true, none), none);
    }

    let mut converging = Watch {
        correlation: 1.0,
        ..started()
    };
    for _ in 0..10 {
        let found = compared(&mut converging, &model, &beyond, true, none);
        assert_eq!(found, HealthStatus::MISFIT);
    }
}

#[test]
fn a_deviation_above_half_the_limit_means_too_little_excitation() {
    let little = HealthStatus::LITTLE_EXCITATION;
    for (row, variance) in [
        (FLOW, 0.0625),
        (COMPLIANCE, 0.00390625),
        (CLEARANCE, 0.015625),
    ] {
        let mut filter = changed(row, HEALTHY[row], variance);
        assert_eq!(
            status(&mut started(), &model(), &filter),
            HealthStatus::empty()
        );
        filter.diagonal[row] *= 1.125;
        assert_eq!(status(&mut started(), &model(), &filter), little);
        // The bit is not latched.
        filter.diagonal[row] = 0.0;
        assert_eq!(
            compared(&mut started(), &model(), &filter, true, little),
            HealthStatus::empty()
        );
    }
    // An uncertain force offset says nothing about the motion.
    let filter = changed(ZERO, 0.0, 1e6);
    assert_eq!(
        status(&mut started(), &model(), &filter),
        HealthStatus::empty()
    );
}

#[test]
fn two_small_but_sure_changes_are_reported_as_several() {
    let several = HealthStatus::SEVERAL_CHANGED;
    // A sixth of the limits: flow 1/12, compliance 1/48 m/N. A change of 0.375 is three deviations of 0.125.
    for (flow, compliance, variance, expected) in [
        (1.09, 0.272, 0.0, true),
        (0.91, 0.228, 0.0, true),
        (1.08, 0.272, 0.0, false),
        (1.09, 0.270, 0.0, false),
        (1.375, 0.5, 0.015625, false),
        (1.25, 0.5, 0.0625 / 9.0 * 1.01, false),
        (1.25, 0.5, 0.0625 / 9.0 * 0.99, true),
    ] {
        let mut filter = Filter::new(HEALTHY, [0.0; STATES]);
        filter.state[FLOW] = flow;
        filter.state[COMPLIANCE] = compliance;
        filter.diagonal[FLOW] = variance;
        let mut watch = started();
        let none = HealthStatus::empty();
        let found = compared(&mut watch, &model(), &filter, true, none);
        assert_eq!(found.contains(several), expected, "{flow}, {compliance}");
        // The bit is not latched, and a change of the force offset does not count.
        let filter = changed(ZERO, 7.0, 0.0);
        assert_eq!(compared(&mut watch, &model(), &filter, true, several), none);
    }
    let mut offset = changed(FLOW, 1.25, 0.0);
    offset.state[ZERO] = 7.0;
    let none = HealthStatus::empty();
    assert_eq!(
        compared(&mut started(), &model(), &offset, true, none),
        none
    );
}
