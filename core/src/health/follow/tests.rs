//! Runs of constant force against numbers computed by hand.

use super::super::block::Block;
use super::super::model::HealthModel;
use super::{CERTAIN, Follow};

/// Nominal half clearance 1 m, noise of a block 0.25 m, contact at 4 N, yielding at 100 N.
fn model() -> HealthModel {
    HealthModel {
        contact_force_n: 4.0,
        yield_force_n: 100.0,
        max_unmeasured: 5,
        start: [1.0, 0.0, 1.0, 0.0],
        missing_m: 2.0,
        still_m: 0.25,
        ..HealthModel::EMPTY
    }
}

/// A block with this mean force (N), all of whose forces are equal, position (m) and nominal travel (m).
fn block(force: f32, position: f32, travel: f32) -> Block {
    Block {
        force,
        position,
        travel,
        lowest: force,
        highest: force,
        ..Block::NONE
    }
}

/// A run that started with this block.
fn started(model: &HealthModel, first: &Block) -> Follow {
    let mut follow = Follow::EMPTY;
    follow.begin();
    follow.take(model, first, [1.0, 1.0], false);
    follow
}

/// The run starts at 0 m and 10 N. Takes a block as often as certainty needs and returns whether the force is missing.
fn is_missing(model: &HealthModel, block: &Block, estimates: [f32; 2], is_idle: bool) -> bool {
    let mut follow = started(
        model,
        &Block {
            position: 0.0,
            travel: 0.0,
            ..*block
        },
    );
    follow.take(model, block, estimates, is_idle);
    let still = Block {
        travel: 0.0,
        ..*block
    };
    for _ in 1..CERTAIN {
        assert!(!follow.is_missing());
        follow.take(model, &still, estimates, is_idle);
    }
    follow.is_missing()
}

#[test]
fn ends_may_move_by_the_clearance_a_margin_and_noise() {
    let model = model();
    // 2 m clearance, 2 m margin, 0.25 m noise; without recent contact the margin is 0.5 mm.
    for sign in [1.0, -1.0] {
        for (moved_m, is_idle, expected) in [
            (4.25, false, false),
            (4.26, false, true),
            (2.2504, true, false),
            (2.2506, true, true),
        ] {
            let block = block(10.0, sign * moved_m, 0.0);
            let found = is_missing(&model, &block, [1.0, 1.0], is_idle);
            assert_eq!(found, expected, "{moved_m} m, idle: {is_idle}");
        }
    }
}

#[test]
fn a_clearance_estimated_below_the_nominal_one_does_not_narrow_the_limit() {
    let model = model();
    for (half_m, moved_m, expected) in [
        (1.5, 5.25, false),
        (1.5, 5.26, true),
        (0.5, 4.25, false),
        (0.5, 4.26, true),
    ] {
        let block = block(10.0, moved_m, 0.0);
        let found = is_missing(&model, &block, [1.0, half_m], false);
        assert_eq!(
            found, expected,
            "half clearance {half_m} m, moved {moved_m} m"
        );
    }
}

#[test]
fn the_piston_may_travel_and_half_of_its_path_may_be_an_error_of_the_law() {
    let model = model();
    // A flow factor of 2 makes 1 m of nominal travel 2 m: positions follow, and the limit becomes 4.25 m + 1 m.
    for (travel_m, moved_m, expected) in [
        (1.0, 7.25, false),
        (1.0, 7.26, true),
        (1.0, -3.25, false),
        (1.0, -3.26, true),
        (-1.0, 3.25, false),
        (-1.0, 3.26, true),
        (-1.0, -7.25, false),
        (-1.0, -7.26, true),
    ] {
        let block = block(10.0, moved_m, travel_m);
        let found = is_missing(&model, &block, [2.0, 1.0], false);
        assert_eq!(found, expected, "travelled {travel_m} m, moved {moved_m} m");
    }
}

#[test]
fn travels_add_up_over_the_blocks_of_a_run() {
    let model = model();
    let mut follow = started(&model, &block(10.0, 0.0, 0.0));
    for number in 1..=3 {
        follow.take(
            &model,
            &block(10.0, 2.0 * number as f32, 1.0),
            [2.0, 1.0],
            false,
        );
    }
    // The position follows the piston exactly.
    assert_eq!((follow.travel, follow.path), (6.0, 6.0));
    assert_eq!((follow.lowest, follow.highest), (0.0, 0.0));
    assert!(!follow.has_moved(&model));
    follow.take(&model, &block(10.0, 6.0, -1.0), [2.0, 1.0], false);
    assert_eq!((follow.travel, follow.path), (4.0, 8.0));
    assert_eq!((follow.lowest, follow.highest), (0.0, 2.0));
    assert!(follow.has_moved(&model));
}

#[test]
fn three_consecutive_blocks_beyond_the_limit_are_certain() {
    let model = model();
    let mut follow = started(&model, &block(10.0, 0.0, 0.0));
    let wide = block(10.0, 5.0, 0.0);
    // A larger clearance allows the same move, which interrupts the count.
    for (half_m, expected) in [
        (1.0, false),
        (1.0, false),
        (2.0, false),
        (1.0, false),
        (1.0, false),
        (1.0, true),
        (1.0, true),
    ] {
        follow.take(&model, &wide, [1.0, half_m], false);
        assert_eq!(follow.is_missing(), expected);
    }
}

#[test]
fn a_move_within_noise_is_no_move() {
    let model = model();
    for (moved_m, expected) in [(0.25, false), (-0.25, false), (0.26, true), (-0.26, true)] {
        let mut follow = started(&model, &block(10.0, 0.0, 0.0));
        follow.take(&model, &block(10.0, moved_m, 0.0), [1.0, 1.0], false);
        assert_eq!(follow.has_moved(&model), expected, "{moved_m} m");
    }
}

#[test]
fn a_run_ends_when_the_force_changes_or_may_yield() {
    let model = model();
    let first = block(10.0, 0.0, 0.0);
    for (next, stays) in [
        (block(14.0, 3.0, 1.0), true),
        (block(6.0, 3.0, 1.0), true),
        (block(14.5, 3.0, 1.0), false),
        (block(5.5, 3.0, 1.0), false),
        (
            Block {
                highest: 100.0,
                ..block(10.0, 3.0, 1.0)
            },
            true,
        ),
        (
            Block {
                highest: 101.0,
                ..block(10.0, 3.0, 1.0)
            },
            false,
        ),
        (
            Block {
                lowest: -100.0,
                ..block(10.0, 3.0, 1.0)
            },
            true,
        ),
        (
            Block {
                lowest: -101.0,
                ..block(10.0, 3.0, 1.0)
            },
            false,
        ),
    ] {
        let mut follow = started(&model, &first);
        follow.take(&model, &next, [1.0, 1.0], false);
        let expected = if stays {
            // The force remains that of the first block.
            Follow {
                force: 10.0,
                travel: 1.0,
                path: 1.0,
                lowest: 0.0,
                highest: 2.0,
                blocks: 1,
                beyond: 0,
            }
        } else {
            started(&model, &next)
        };
        assert_eq!(follow, expected, "{next:?}");
    }
}

#[test]
fn the_first_block_starts_a_run_even_at_rest_away_from_zero() {
    let model = model();
    let follow = started(&model, &block(0.0, 5.0, 0.0));
    assert_eq!((follow.lowest, follow.highest), (5.0, 5.0));
    assert!(!follow.has_moved(&model));
}

#[test]
fn a_new_run_forgets_the_count_of_the_old_one() {
    let model = model();
    let mut follow = started(&model, &block(10.0, 0.0, 0.0));
    for _ in 0..CERTAIN {
        follow.take(&model, &block(10.0, 9.0, 0.0), [1.0, 1.0], false);
    }
    assert!(follow.is_missing());
    let next = block(20.0, 9.0, 3.0);
    follow.take(&model, &next, [1.0, 1.0], false);
    assert_eq!(follow, started(&model, &next));
    assert_eq!(
        (follow.lowest, follow.highest, follow.travel),
        (9.0, 9.0, 0.0)
    );
    assert!(!follow.is_missing());
}

#[test]
fn a_run_lasts_at_most_twice_the_longest_crossing() {
    let model = model();
    let mut follow = started(&model, &block(10.0, 0.0, 0.0));
    for number in 1..=10 {
        follow.take(&model, &block(10.0, 1.0, 0.0), [1.0, 1.0], false);
        assert_eq!(follow.blocks, number);
    }
    follow.take(&model, &block(10.0, 1.0, 0.0), [1.0, 1.0], false);
    assert_eq!(follow, started(&model, &block(10.0, 1.0, 0.0)));
}

#[test]
fn the_block_after_an_incomplete_one_starts_a_run() {
    let model = model();
    let mut follow = started(&model, &block(10.0, 0.0, 0.0));
    let incomplete = Block {
        lowest: -f32::MAX,
        highest: f32::MAX,
        ..block(10.0, 5.0, 0.0)
    };
    follow.take(&model, &incomplete, [1.0, 1.0], false);
    let next = block(10.0, 1.0, 0.0);
    follow.take(&model, &next, [1.0, 1.0], false);
    assert_eq!(follow, started(&model, &next));
}
