//! Fixed bug: a NaN that damage put into a state persisted. Its sign differed between processors, so saved states
//! differed.

use dashpot::damper;
use dashpot::memory::{PlainData, bytes};
use dashpot_core::{Damper, DamperState, Real};
use fastrand::Rng;

fn no_number_is_nan_after_a_step<T: Real>(seed: u64)
where
    DamperState<T>: PlainData,
{
    let mut random = Rng::with_seed(seed);
    for preset in ["paper", "in-service", "reduced-lateral"] {
        let damper: Damper<T> = damper(preset, &[]).build(1e-3).expect("a preset");
        for _ in 0..20_000 {
            let mut state = damper.at_rest(T::ZERO);
            let sound = state;
            random.fill(bytes(&mut state));
            let behind_numbers = 4 * size_of::<T>();
            if random.bool() {
                // Revision and mark of a state that this damper stepped.
                let mut sound = sound;
                bytes(&mut state)[behind_numbers..]
                    .copy_from_slice(&bytes(&mut sound)[behind_numbers..]);
            }
            for number in 0..4 {
                // Every second value gets the exponent of NaN.
                if random.bool() {
                    let end = (number + 1) * size_of::<T>();
                    bytes(&mut state)[end - 2..end].copy_from_slice(&[0xf0, 0x7f | random.u8(..)]);
                }
            }
            let x = T::from_f64([0.0, 1e-3, f64::NAN, 1e30][random.usize(..4)]);
            damper.step(&mut state, x);
            let reals = state.displacement_m() + state.piston_displacement_m() + state.force_n();
            assert!(reals.is_finite(), "{preset}: {state:?}");
            let text = format!("{state:?}");
            assert!(
                !text.contains("NaN") && !text.contains("inf"),
                "{preset}: {text}"
            );
        }
    }
}

#[test]
fn no_number_of_an_f32_state_is_nan_after_a_step() {
    no_number_is_nan_after_a_step::<f32>(1);
}

#[test]
fn no_number_of_an_f64_state_is_nan_after_a_step() {
    no_number_is_nan_after_a_step::<f64>(2);
}
