//! Images with changed constants and valid checksums are accepted as dampers. Whatever the constants, a step's force is
//! within its limit.

use std::cell::Cell;

use dashpot::damper;
use dashpot::signed_image::{SCALARS, TABLE, sum_and_sign, word};
use dashpot_core::parameters::MAX_FORCE_N;
use dashpot_core::{Damper, ImageError};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::TestRunner;

/// Number of images.
const CASES: u32 = 2000;

macro_rules! a_changed_image_steps_within_the_limit {
    ($test:ident, $float:ident) => {
        #[test]
        fn $test() {
            use proptest::num::$float::{ANY, NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};

            let preset: Damper<$float> = damper("in-service", &[]).build(1e-3).expect("a preset");
            let image = preset.to_image();
            let magnitude = NORMAL | SUBNORMAL | ZERO;
            let coefficients = vec((any::<Index>(), magnitude | POSITIVE | NEGATIVE), 0..100);
            let scalars = vec((0..SCALARS, magnitude | POSITIVE), 0..3);
            let displacements = vec(prop_oneof![4 => -0.1..0.1 as $float, 1 => ANY], 1..20);
            let mut runner = TestRunner::new(ProptestConfig {
                source_file: Some(file!()),
                ..ProptestConfig::with_cases(CASES)
            });
            let stepped = Cell::new(0);
            let outcome = runner.run(
                &(coefficients, scalars, displacements),
                |(coefficients, scalars, displacements)| {
                    let mut image = image;
                    let coefficients = coefficients.into_iter().map(|(index, value)| {
                        let coefficient = index.index(Damper::<$float>::WORDS - TABLE);
                        (TABLE + coefficient, value)
                    });
                    for (index, value) in coefficients.chain(scalars) {
                        let bytes = value.to_le_bytes();
                        word::<$float>(&mut image, index).copy_from_slice(&bytes);
                    }
                    sum_and_sign::<$float>(&mut image);
                    let damper = match Damper::<$float>::from_image(&image) {
                        Ok(damper) => damper,
                        Err(refused) => {
                            let no_number = matches!(refused, ImageError::Scalars | ImageError::Piece(_));
                            prop_assert!(no_number, "{refused:?}");
                            return Ok(());
                        }
                    };
                    stepped.set(stepped.get() + 1);
                    let limit = damper.force_limit_n();
                    prop_assert!((0.0..=MAX_FORCE_N as $float).contains(&limit));
                    let mut state = damper.at_rest(0.0);
                    for x in displacements {
                        let force = damper.step(&mut state, x);
                        prop_assert!(force.abs() <= limit, "{force} N beyond {limit} N");
                    }
                    Ok(())
                },
            );
            outcome.unwrap_or_else(|failure| panic!("{failure}"));
            let stepped = stepped.get();
            assert!(stepped >= CASES / 2, "{stepped} of {CASES} images stepped");
        }
    };
}

a_changed_image_steps_within_the_limit!(a_changed_f32_image_steps_within_the_limit, f32);
a_changed_image_steps_within_the_limit!(a_changed_f64_image_steps_within_the_limit, f64);
