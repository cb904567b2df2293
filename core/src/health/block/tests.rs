//! A block against numbers computed by hand. All of them are exact in single precision.

use super::super::model::{HealthModel, PIECES, Piece};
use super::{Block, Gathered};

const STEP_S: f32 = 0.25;

/// Laws of one line for each side, a block of eight ticks and a step of 1/4 s.
///
/// Extension: `v = 0.5 + F/4`, oil `1 + F/8`. Compression: `v = 0.25 + F/2`, oil `2 + F/4`.
fn model() -> HealthModel {
    let extension = Piece {
        velocity: 0.5,
        velocity_slope: 0.25,
        oil: 1.0,
        oil_slope: 0.125,
    };
    let compression = Piece {
        velocity: 0.25,
        velocity_slope: 0.5,
        oil: 2.0,
        oil_slope: 0.25,
    };
    HealthModel {
        half_step_s: 0.5 * STEP_S,
        block_ticks: 8,
        per_block: 1.0 / 8.0,
        per_block_s: 1.0 / (8.0 * STEP_S),
        block_centre: 3.5,
        // The squared distances of eight ticks from their centre sum to 42. This power of two keeps the sums exact.
        rate_scale_per_s: 1.0 / 64.0,
        pieces: [[extension; PIECES], [compression; PIECES]],
        ..HealthModel::EMPTY
    }
}

/// A started block with these corrections (N).
fn started(model: &HealthModel, zero_n: f32, friction_n: f32) -> Gathered {
    let mut gathered = Gathered::EMPTY;
    gathered.correct(zero_n, friction_n);
    gathered.begin(model);
    gathered
}

/// Adds a sample as a tick does.
fn tick(gathered: &mut Gathered, model: &HealthModel, displacement_m: f32, force_n: f32) {
    gathered.add(model, displacement_m, force_n);
    gathered.ticks_left -= 1;
}

/// Leaves out a sample as a tick does.
fn miss(gathered: &mut Gathered, model: &HealthModel, displacement_m: f32) -> bool {
    let is_blind = gathered.leave_out(model, displacement_m);
    gathered.ticks_left -= 1;
    is_blind
}

#[test]
fn a_ramp_of_force_gives_its_means_its_rate_and_the_travel_of_the_trapezoidal_rule() {
    let model = model();
    let mut gathered = started(&model, 1.0, 2.0);
    for number in 0..8 {
        // Forces 9, 11, ..., 23 N without the offset. The laws see 7, 9, ..., 21 N: v = 2.25, 2.75, ..., 5.75 m/s.
        tick(&mut gathered, &model, 100.0, 10.0 + 2.0 * number as f32);
    }
    let block = gathered.block(&model);
    assert_eq!(gathered.ticks_left, 0);
    // The sum of the velocities is 32 m/s; the first comes after rest and the last counts half.
    assert_eq!(block.travel, STEP_S * (32.0 - 5.75 / 2.0));
    // Travel up to tick k: 2.25 k + 1.125 + k^2/4 steps; mean over k = 0 to 7: 107/8.
    assert_eq!(block.centre, STEP_S * 107.0 / 8.0);
    assert_eq!(block.velocity, block.travel / (8.0 * STEP_S));
    assert_eq!(block.position, 100.0 - (1.0 + 14.0 / 8.0));
    assert_eq!(block.force, 16.0);
    // Moments about the centre: 2 N/tick times 42 ticks^2.
    assert_eq!(block.rate, 84.0 / 64.0);
    assert_eq!(block.slope, 0.25);
    assert_eq!((block.lowest, block.highest), (9.0, 23.0));
    assert_eq!((block.zero, block.friction), (1.0, 2.0));
    assert!(!block.is_incomplete());
}

#[test]
fn compression_uses_its_own_laws_with_negative_sign() {
    let model = model();
    let mut gathered = started(&model, 0.0, 2.0);
    for _ in 0..8 {
        tick(&mut gathered, &model, 0.0, -10.0);
    }
    let block = gathered.block(&model);
    // The laws see 8 N: v = -4.25 m/s and an oil column of -4 m.
    assert_eq!(block.travel, -4.25 * STEP_S * 7.5);
    assert_eq!(block.position, 4.0);
    assert_eq!((block.force, block.slope), (-10.0, 0.5));
    assert_eq!((block.lowest, block.highest), (-10.0, -10.0));
    assert_eq!(block.rate, 0.0);
}

#[test]
fn a_force_below_the_added_friction_counts_as_no_force_in_the_laws() {
    let model = model();
    let mut gathered = started(&model, 0.0, 20.0);
    for _ in 0..8 {
        tick(&mut gathered, &model, 5.0, 10.0);
    }
    let block = gathered.block(&model);
    assert_eq!(block.travel, 0.5 * STEP_S * 7.5);
    assert_eq!(block.position, 5.0 - 1.0);
    assert_eq!(block.force, 10.0);
}

#[test]
fn the_next_block_starts_from_the_last_velocity_and_from_empty_sums() {
    let model = model();
    let mut gathered = started(&model, 0.0, 0.0);
    for _ in 0..8 {
        tick(&mut gathered, &model, 0.0, 6.0);
    }
    gathered.begin(&model);
    for _ in 0..8 {
        tick(&mut gathered, &model, 0.0, 6.0);
    }
    let block = gathered.block(&model);
    // 2 m/s throughout: no half step is lost.
    assert_eq!(block.travel, 2.0 * 8.0 * STEP_S);
    assert_eq!(block.force, 6.0);
    assert_eq!(block.rate, 0.0);
}

#[test]
fn a_block_with_a_missing_sample_is_incomplete_and_the_piston_keeps_its_velocity() {
    let model = model();
    let mut gathered = started(&model, 0.0, 0.0);
    tick(&mut gathered, &model, 0.0, 6.0);
    for _ in 1..8 {
        assert!(!miss(&mut gathered, &model, 0.0));
    }
    let block = gathered.block(&model);
    assert!(block.is_incomplete());
    // Every limit of force is exceeded on both sides.
    assert_eq!((block.lowest, block.highest), (-f32::MAX, f32::MAX));
    // 2 m/s: half a step up to the sample, then seven steps.
    assert_eq!(block.travel, 2.0 * STEP_S * 7.5);
}

#[test]
fn only_a_block_without_any_sample_loses_the_piston() {
    let model = model();
    let mut gathered = started(&model, 0.0, 0.0);
    for _ in 0..8 {
        tick(&mut gathered, &model, 0.0, 6.0);
    }
    gathered.begin(&model);
    for _ in 0..7 {
        assert!(!miss(&mut gathered, &model, 0.0));
    }
    assert!(miss(&mut gathered, &model, 0.0));
    // 2 m/s for seven steps, then unknown and taken as 0.
    assert_eq!(gathered.block(&model).travel, 2.0 * 7.0 * STEP_S);
    gathered.begin(&model);
    tick(&mut gathered, &model, 0.0, 6.0);
    assert_eq!(gathered.travel, 2.0 * 0.5 * STEP_S);
}

#[test]
fn one_sample_at_any_place_keeps_the_piston() {
    let model = model();
    for place in 0..8 {
        let mut gathered = started(&model, 0.0, 0.0);
        for number in 0..8 {
            if number == place {
                tick(&mut gathered, &model, 0.0, 6.0);
            } else {
                assert!(!miss(&mut gathered, &model, 0.0), "sample at {place}");
            }
        }
    }
}

#[test]
fn a_displacement_is_kept_for_the_next_move_only_if_it_is_possible() {
    let model = model();
    let mut gathered = started(&model, 0.0, 0.0);
    for (displacement_m, kept_m) in [
        (3.0, 3.0),
        (f32::NAN, 3.0),
        (f32::INFINITY, 3.0),
        (1001.0, 3.0),
        (-1001.0, 3.0),
        (-1000.0, -1000.0),
    ] {
        miss(&mut gathered, &model, displacement_m);
        assert_eq!(gathered.displacement, kept_m, "after {displacement_m} m");
    }
}

#[test]
fn a_block_of_real_forces_is_complete() {
    let with = |lowest| Block {
        lowest,
        ..Block::NONE
    };
    assert!(!Block::NONE.is_incomplete());
    assert!(!with(-1e7).is_incomplete());
    assert!(with(-f32::MAX).is_incomplete());
}
