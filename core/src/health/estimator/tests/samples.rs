//! Samples in and readings out.

use super::super::super::filter::{COMPLIANCE, FLOW, FRICTION, Filter, STATES, ZERO};
use super::super::super::reading::HealthStatus;
use super::super::{Health, stage};
use super::model;

#[test]
fn a_reading_converts_the_states_and_their_variances() {
    let model = model();
    let mut health = Health::new(&model);
    health.filter = Filter::new(
        [9.0, 1.5, 0.25, 0.125, 0.001, -30.0, 20.0],
        [1.0, 4.0, 0.0625, 9.0, 16.0, 25.0, 36.0],
    );
    let reading = health.reading(&model);
    let found = [
        reading.flow_factor,
        reading.compliance_m_per_n,
        reading.stiffness_n_per_m,
        reading.clearance_m,
        reading.lag_s,
        reading.force_zero_n,
        reading.added_friction_n,
    ]
    .map(|estimate| (estimate.value, estimate.sd));
    // Stiffness 1/kappa with the deviation sd(kappa)/kappa^2; the clearance is twice its half.
    let expected = [
        (1.5, 2.0),
        (0.25, 0.25),
        (4.0, 4.0),
        (0.25, 6.0),
        (0.001, 4.0),
        (-30.0, 5.0),
        (20.0, 6.0),
    ];
    assert_eq!(found, expected);
    assert_eq!(reading.status, HealthStatus::empty());

    // A mean squared innovation of 1 + 8/128 times its variance increases every deviation by the root of this.
    health.watch.average_square(9.0);
    let sd = health.reading(&model).flow_factor.sd;
    assert!((sd * sd - 4.0 * 1.0625).abs() < 1e-5);

    // A mount of at most a thousandth of the nominal compliance of 0.5 m/N; a flow that drives the piston.
    health.filter.state[COMPLIANCE] = -1.0;
    health.filter.state[FLOW] = 0.0;
    let reading = health.reading(&model);
    assert_eq!(reading.stiffness_n_per_m.value, 1.0 / (1e-3 * 0.5));
    assert_eq!(reading.compliance_m_per_n.value, -1.0);
    assert_eq!(reading.status, HealthStatus::MISFIT);
}

#[test]
fn a_block_is_corrected_by_the_offset_and_friction_known_at_its_start() {
    let model = model();
    let mut health = Health::new(&model);
    health.filter.state[ZERO] = 3.0;
    health.filter.state[FRICTION] = 2.0;
    for block in 0..2 {
        for _ in 0..8 {
            health.tick(&model, 0.0, 10.0);
        }
        let corrections = [(0.0, 0.0), (3.0, 2.0)][block];
        assert_eq!((health.block.zero, health.block.friction), corrections);
        assert_eq!(health.stage, stage::PREDICT);
    }
    // The first block lacks its first sample, because no move to it is known.
    assert_eq!(health.block.force, 7.0);
    assert_eq!(health.rejected, 0);
    assert!(!health.status().contains(HealthStatus::INPUT_REJECTED));
}

#[test]
fn the_work_on_a_block_is_done_within_the_next_one() {
    let model = model();
    let mut health = Health::new(&model);
    health.filter = Filter::new(health.filter.state, [1e-3; STATES]);
    // The first sample of all only gives the reference of the next move. The second block is in contact.
    for _ in 0..16 {
        health.tick(&model, 1.0, 20.0);
    }
    let before = health.filter;
    for expected in [
        stage::PREPARE,
        stage::UPDATE_FIRST,
        stage::UPDATE_SECOND,
        stage::FOLLOW,
        stage::COMPARE_FIRST,
        stage::COMPARE_SECOND,
        stage::FORGET,
        stage::PREDICT,
    ] {
        health.tick(&model, 1.0, 20.0);
        assert_eq!(health.stage, expected);
    }
    assert_eq!((health.samples, health.unmeasured), (8, 0));
    assert!(health.filter.state != before.state);
    // Forgetting was the last stage: no forgetting is pending.
    assert_eq!(health.forgetting, 0.0);
}

#[test]
fn samples_that_are_not_credible_are_counted_and_make_their_block_incomplete() {
    let model = model();
    // Largest move 10 m, largest force 1000 N.
    for (displacement_m, force_n, is_credible) in [
        (10.0, 1000.0, true),
        (-10.0, -1000.0, true),
        (10.1, 0.0, false),
        (-10.1, 0.0, false),
        (0.0, 1000.5, false),
        (0.0, -1000.5, false),
        (f32::NAN, 0.0, false),
        (0.0, f32::NAN, false),
    ] {
        let mut health = Health::new(&model);
        for _ in 0..8 {
            health.tick(&model, 0.0, 0.0);
        }
        health.tick(&model, displacement_m, force_n);
        assert_eq!(
            health.rejected,
            u32::from(!is_credible),
            "{displacement_m} m, {force_n} N"
        );
        assert_eq!(
            health.status().contains(HealthStatus::INPUT_REJECTED),
            !is_credible
        );
        assert_eq!(health.gathered.block(&model).is_incomplete(), !is_credible);
    }
}

#[test]
fn the_move_between_two_samples_counts_not_their_place() {
    let model = model();
    // Largest move 10 m.
    for (start_m, end_m, is_credible) in [
        (100.0, 110.0, true),
        (-100.0, -110.0, true),
        (6.0, -6.0, false),
        (-6.0, 6.0, false),
    ] {
        let mut health = Health::new(&model);
        health.tick(&model, start_m, 0.0);
        health.tick(&model, end_m, 0.0);
        assert_eq!(
            health.rejected,
            u32::from(!is_credible),
            "{start_m} m to {end_m} m"
        );
    }
}

#[test]
fn a_block_without_samples_counts_as_the_longest_crossing() {
    let model = model();
    let mut health = Health::new(&model);
    for _ in 0..8 {
        health.tick(&model, 0.0, 0.0);
    }
    health.stage = stage::DONE;
    for _ in 0..7 {
        health.tick(&model, f32::NAN, 0.0);
    }
    assert_eq!(health.unmeasured, 0);
    health.tick(&model, f32::NAN, 0.0);
    assert_eq!(health.unmeasured, 62);
    assert_eq!(health.rejected, 8);
}

#[test]
fn clearing_the_status_clears_the_count_and_keeps_the_estimate() {
    let model = model();
    let mut health = Health::new(&model);
    health.status = HealthStatus::FLOW | HealthStatus::INPUT_REJECTED;
    health.rejected = 9;
    let filter = health.filter;
    health.clear_status();
    assert_eq!(
        (health.status(), health.rejected),
        (HealthStatus::empty(), 0)
    );
    assert_eq!(health.filter, filter);
    assert!(health.is_marked());
    assert!(!Health::EMPTY.is_marked());
}
