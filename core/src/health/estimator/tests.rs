//! Stages before the update of the filter, against numbers computed by hand, most of them exact in single precision.

use super::super::block::Block;
use super::super::filter::{Filter, POSITION, STATES, ZERO};
use super::super::model::{Baseline, HealthLimits, HealthModel};
use super::{Health, UNKNOWN, stage};

mod after_update;
mod samples;

/// Round numbers instead of those of a real damper.
fn model() -> HealthModel {
    HealthModel {
        half_step_s: 0.125,
        max_move_m: 10.0,
        max_force_n: 1000.0,
        block_ticks: 8,
        block_centre: 3.5,
        per_block: 0.125,
        contact_force_n: 4.0,
        yield_force_n: 100.0,
        measured_variance: 2.0,
        force_travel_variance: 8.0,
        law_variance: 2.0,
        growth: 1.25,
        lag_growth: 1.0625,
        max_unmeasured: 62,
        alarm_blocks: 3,
        start: [1.0, 0.5, 0.25, 0.0],
        start_variance: [64.0; STATES - 1],
        oil_compliance: 0.25,
        block_s: 2.0,
        still_m: 0.125,
        missing_m: 2.0,
        zero_limit_n: 100.0,
        baseline: Baseline::new(1.0, 0.5, 0.5),
        limits: HealthLimits::default(),
        ..HealthModel::EMPTY
    }
}

/// Mean force 16 N and travel 0.5 m, corrected by an offset of 1 N and a friction of 2 N.
const BLOCK: Block = Block {
    travel: 0.5,
    centre: 0.25,
    position: 3.0,
    force: 16.0,
    velocity: 0.5,
    rate: 2.0,
    slope: 0.25,
    lowest: 12.0,
    highest: 20.0,
    zero: 1.0,
    friction: 2.0,
};

/// The block with other bounds of its forces (N).
fn between(lowest: f32, highest: f32) -> Block {
    Block {
        lowest,
        highest,
        ..BLOCK
    }
}

/// The estimate after a block: piston at 1 m, flow factor 2, compliance 0.5 m/N, offset 1.5 N, friction 3 N.
fn with_block(model: &HealthModel, block: Block) -> Health {
    let mut health = Health::new(model);
    health.filter = Filter::new(
        [1.0, 2.0, 0.5, 0.25, 0.0, 1.5, 3.0],
        [0.5, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0],
    );
    health.block = block;
    health.stage = stage::PREDICT;
    health
}

fn predicted(model: &HealthModel, block: Block) -> Health {
    let mut health = with_block(model, block);
    health.predict(model);
    health
}

fn is_measured(health: &Health) -> bool {
    health.stage == stage::PREPARE
}

#[test]
fn an_extension_block_moves_the_piston_and_gives_a_measurement() {
    let health = predicted(&model(), BLOCK);
    // A newton of offset or friction costs 2 * 0.25 m/(s N) * 2 s = 1 m of travel. 0.5 N and 1 N are new.
    assert_eq!(health.filter.state[POSITION], 1.0 + 2.0 * 0.5 - 0.5 - 1.0);
    // 8 N^2 s^2 times the squared slope and 2 times the squared travel.
    assert_eq!(
        health.filter.diagonal[POSITION],
        0.5 + 8.0 / 16.0 + 2.0 / 4.0
    );
    assert!(is_measured(&health));
    // Half of the lost travel is before the centre of the block; 0.75 m/N are springs.
    assert_eq!(health.prepared.measured, 3.0 + 0.25 * 0.5 - 0.5 * 1.0);
    // The ends move at 2 * 0.5 m/s + 0.5 m/N * 2 N/s.
    assert_eq!(health.prepared.parts, [-0.25, 16.0, 1.0, 2.0, -0.25, 0.5]);
    assert_eq!(health.unmeasured, 1);
}

#[test]
fn in_compression_friction_acts_the_other_way_and_the_clearance_has_the_other_sign() {
    let block = Block {
        travel: -0.5,
        force: -16.0,
        lowest: -20.0,
        highest: -12.0,
        ..BLOCK
    };
    let health = predicted(&model(), block);
    assert_eq!(health.filter.state[POSITION], 1.0 - 2.0 * 0.5 - 0.5 + 1.0);
    assert!(is_measured(&health));
    assert_eq!(health.prepared.measured, 3.0 + 0.25 * 0.5 + 0.5 * 1.0);
    assert_eq!(health.prepared.parts, [0.75, -16.0, -1.0, 2.0, -0.25, -0.5]);
}

#[test]
fn forces_measure_only_beyond_the_contact_threshold_by_three_deviations_of_the_offset() {
    // The threshold is 4 N and the offset has a deviation of 2 N, so 10 N are enough.
    for (lowest, highest, expected) in [
        (10.0, 20.0, true),
        (9.5, 20.0, false),
        (9.0, 20.0, false),
        (7.0, 20.0, false),
        (5.0, 20.0, false),
        (-20.0, 20.0, false),
        (-20.0, -9.5, false),
        (-20.0, -9.0, false),
        (-20.0, -7.0, false),
        (-20.0, -10.0, true),
    ] {
        let health = predicted(&model(), between(lowest, highest));
        assert_eq!(is_measured(&health), expected, "{lowest} to {highest} N");
    }
}

#[test]
fn a_force_at_the_contact_threshold_does_not_measure_even_with_a_known_offset() {
    let model = model();
    for (lowest, highest, expected) in [
        (4.0, 20.0, false),
        (4.5, 20.0, true),
        (-20.0, -4.0, false),
        (-20.0, -4.5, true),
    ] {
        let mut health = with_block(&model, between(lowest, highest));
        health.filter.diagonal[ZERO] = 0.0;
        health.predict(&model);
        assert_eq!(is_measured(&health), expected, "{lowest} to {highest} N");
    }
}

#[test]
fn a_yielding_block_releases_the_piston_and_does_not_measure() {
    for (lowest, highest, yields) in [
        (12.0, 100.0, false),
        (12.0, 101.0, true),
        (-100.0, -12.0, false),
        (-101.0, -12.0, true),
    ] {
        let health = predicted(&model(), between(lowest, highest));
        assert_eq!(is_measured(&health), !yields, "{lowest} to {highest} N");
        let is_released = health.filter.diagonal[POSITION] == UNKNOWN;
        // The variance of a piston that is not released is 1.5 m^2 here.
        assert_eq!(is_released, yields, "{lowest} to {highest} N");
    }
}

#[test]
fn the_piston_is_released_after_the_longest_crossing_of_the_clearance() {
    let model = model();
    let block = between(-1.0, 1.0);
    for (unmeasured, variance_m2) in [(60, 1.5), (61, 1.5), (62, UNKNOWN), (1000, UNKNOWN)] {
        let mut health = with_block(&model, block);
        health.unmeasured = unmeasured;
        health.predict(&model);
        assert_eq!(health.unmeasured, unmeasured + 1);
        assert_eq!(
            health.filter.diagonal[POSITION], variance_m2,
            "{unmeasured}"
        );
    }
}

/// The stage after preparing a measurement of a flow factor of 0 with variance `flow` and of a piston at 0 m with
/// variance 1 m^2, where the measurement has the variance 2 m^2.
fn prepared(model: &HealthModel, measured_m: f32, flow: f32) -> Health {
    let mut health = Health::new(model);
    health.filter = Filter::new([0.0; STATES], [1.0, flow, 0.0, 0.0, 0.0, 0.0, 0.0]);
    health.prepared.measured = measured_m;
    health.prepared.parts = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    health.unmeasured = 5;
    health.outliers = 5;
    health.prepare(model);
    health
}

#[test]
fn a_measurement_thirty_deviations_off_is_left_out() {
    let model = model();
    // The expected variance is 2 + 1 + 1 = 4 m^2.
    for (measured_m, is_used) in [(59.0, true), (-59.0, true), (60.0, false), (-61.0, false)] {
        let health = prepared(&model, measured_m, 1.0);
        let expected = if is_used {
            (stage::UPDATE_FIRST, 0, 0, 8)
        } else {
            (stage::LEAVE_OUT, 5, 5, 0)
        };
        let found = (
            health.stage,
            health.outliers,
            health.unmeasured,
            health.samples,
        );
        assert_eq!(found, expected, "{measured_m} m");
    }
    assert_eq!(prepared(&model, f32::NAN, 1.0).stage, stage::LEAVE_OUT);
}

#[test]
fn an_unexpected_block_forgets_in_proportion_to_its_squared_innovation_up_to_nine() {
    let model = model();
    // The expected variance is 2 + 1 + 13 = 16 m^2.
    for (measured_m, forgetting) in [(0.0, 1.0), (2.0, 1.0), (4.0, 1.0), (8.0, 4.0), (40.0, 9.0)] {
        let health = prepared(&model, measured_m, 13.0);
        assert_eq!(health.forgetting, forgetting, "{measured_m} m");
    }
}

#[test]
fn a_block_without_information_forgets_nothing() {
    // With a growth of 2, information must exceed a quarter of the expected variance, that is 1 of 4 m^2.
    let model = HealthModel {
        growth: 2.0,
        ..model()
    };
    for (flow, forgetting) in [(0.5, 0.0), (1.0, 0.0), (1.5, 1.0)] {
        assert_eq!(prepared(&model, 0.0, flow).forgetting, forgetting, "{flow}");
    }
}
