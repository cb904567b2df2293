//! A bank equals single steps, bit for bit.

use dashpot::damper;
use dashpot_core::{Damper, Real, step_bank};
use proptest::prelude::*;

/// Compares every force and state of a bank of `N` with single steps.
fn agrees<T: Real, const N: usize>(moves: &[[f64; 19]]) {
    let dampers: [Damper<T>; 3] = [
        ("paper", "mount.clearance_m=1e-3"),
        ("in-service", "mount.clearance_m=0.0"),
        ("reduced-lateral", "mount.clearance_m=2e-3"),
    ]
    .map(|(name, set)| damper(name, &[set]).build(1e-3).unwrap());
    let bank: [&Damper<T>; N] = std::array::from_fn(|i| &dampers[i % 3]);
    let mut states = bank.map(|damper| damper.at_rest(T::ZERO));
    let mut alone = states;
    let mut forces = [T::ZERO; N];
    let mut positions = [0.0; N];
    for row in moves {
        let xs = std::array::from_fn(|i| {
            positions[i] += row[i];
            T::from_f64(if row[i] > 9e-3 {
                f64::NAN
            } else {
                positions[i]
            })
        });
        step_bank(&bank, &mut states, &xs, &mut forces);
        for i in 0..N {
            let force = bank[i].step(&mut alone[i], xs[i]);
            assert_eq!(force.to_bits_u64(), forces[i].to_bits_u64(), "damper {i}");
        }
        assert_eq!(states, alone);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn bank_equals_single_steps(
        moves in prop::collection::vec(prop::array::uniform19(-1e-3..1e-3_f64), 1..60),
        bad in 0..60_usize,
        jump in -1.0..1.0_f64,
    ) {
        let mut moves = moves;
        let row = bad % moves.len();
        moves[row][bad % 19] = jump;
        agrees::<f32, 1>(&moves);
        agrees::<f32, 16>(&moves);
        agrees::<f32, 19>(&moves);
        agrees::<f64, 16>(&moves);
    }
}
