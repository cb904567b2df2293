//! A bank equals single steps, bit for bit, at every width of the processor's vectors and for any number of dampers.

use std::sync::Once;

use dashpot::damper;
use dashpot::memory::{PlainData, bytes};
use dashpot_core::{Damper, DamperState, Real, VectorWidth, step_bank, step_bank_with};
use fastrand::Rng;
use proptest::prelude::*;

/// Largest number of dampers: two groups of 16, one of 8.
const MOST: usize = 40;

/// Widths that the processor has; the log of the test names them.
fn widths() -> Vec<VectorWidth> {
    let (baseline, widest) = (VectorWidth::baseline(), VectorWidth::detect());
    let mut widths = vec![baseline];
    if widest.name() != baseline.name() {
        widths.push(widest);
    }
    static PRINTED: Once = Once::new();
    PRINTED.call_once(|| {
        let names: Vec<_> = widths.iter().map(|width| width.name()).collect();
        eprintln!("widths compared with single steps: {}", names.join(", "));
    });
    widths
}

/// Numbers with their bits, so that NaN equals itself.
fn all_bits<T: Real>(state: &mut DamperState<T>) -> Vec<u8>
where
    DamperState<T>: PlainData,
{
    bytes(state).to_vec()
}

/// Steps `count` mixed dampers through a random motion at every width, beside single steps.
fn agrees<T: Real>(dampers: &[Damper<T>], count: usize, unusual_per_mille: u32, seed: u64)
where
    DamperState<T>: PlainData,
{
    for width in widths() {
        let mut random = Rng::with_seed(seed);
        let pick = |random: &mut Rng| &dampers[random.usize(..dampers.len())];
        let mut bank: Vec<&Damper<T>> = (0..count).map(|_| pick(&mut random)).collect();
        let mut states: Vec<_> = bank.iter().map(|damper| damper.at_rest(T::ZERO)).collect();
        let mut alone = states.clone();
        let mut positions = vec![0.0; count];
        let mut forces = vec![T::ZERO; count];
        for tick in 0..60 {
            let xs: Vec<T> = (0..count)
                .map(|slot| {
                    let usual = [1e-6, 2e-5, 1e-4, 1e-3][slot % 4] * (random.f64() - 0.4);
                    positions[slot] += usual;
                    if random.u32(..1000) >= unusual_per_mille {
                        return T::from_f64(positions[slot]);
                    }
                    match random.u32(..8) {
                        0 => return T::from_f64(f64::NAN),
                        1 => return T::from_f64(f64::INFINITY),
                        2 => return T::from_f64(f64::NEG_INFINITY),
                        3 => return T::from_f64(-1e300),
                        // Too fast, or too far away.
                        4 => positions[slot] += 4e-3,
                        5 => positions[slot] = random.f64() - 0.5,
                        6 => bank[slot] = pick(&mut random),
                        _ => {
                            let byte = random.usize(..size_of::<DamperState<T>>());
                            let bit = 1 << random.u32(..8);
                            bytes(&mut states[slot])[byte] ^= bit;
                            bytes(&mut alone[slot])[byte] ^= bit;
                        }
                    }
                    T::from_f64(positions[slot])
                })
                .collect();
            step_bank_with(width, &bank, &mut states, &xs, &mut forces);
            for slot in 0..count {
                let force = bank[slot].step(&mut alone[slot], xs[slot]);
                let at = || format!("{}, damper {slot} of {count}, tick {tick}", width.name());
                assert_eq!(force.to_bits_u64(), forces[slot].to_bits_u64(), "{}", at());
                let [left, right] = [&mut states[slot], &mut alone[slot]].map(all_bits);
                assert_eq!(left, right, "{}", at());
            }
        }
    }
}

/// Dampers with and without clearance; one yields often.
fn dampers<T: Real>() -> Vec<Damper<T>> {
    [
        ("paper", "mount.clearance_m=1e-3"),
        ("in-service", "mount.clearance_m=0.0"),
        ("reduced-lateral", "mount.clearance_m=2e-3"),
        ("reduced-vertical", "mount.clearance_m=1e-4"),
    ]
    .map(|(name, set)| damper(name, &[set]).build(1e-3).unwrap())
    .into()
}

/// Compares banks of every number of dampers, without and with unusual inputs and states.
fn every_count_agrees<T: Real>()
where
    DamperState<T>: PlainData,
{
    let dampers = dampers::<T>();
    for count in 1..=MOST {
        agrees(&dampers, count, 0, 1);
        agrees(&dampers, count, 30, 2);
    }
}

#[test]
fn a_bank_of_any_size_equals_single_steps_in_f32() {
    every_count_agrees::<f32>();
}

#[test]
fn a_bank_of_any_size_equals_single_steps_in_f64() {
    every_count_agrees::<f64>();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn bank_equals_single_steps(
        count in 1..=MOST,
        unusual_per_mille in prop::sample::select(vec![0, 3, 100, 1000]),
        seed: u64,
    ) {
        agrees(&dampers::<f32>(), count, unusual_per_mille, seed);
        agrees(&dampers::<f64>(), count, unusual_per_mille, seed);
    }
}

/// The call for arrays, and slices of different lengths.
#[test]
fn arrays_step_as_slices_and_the_shortest_slice_counts() {
    let damper = &dampers::<f32>()[0];
    let at_rest = [damper.at_rest(0.0); 19];
    let (mut of_arrays, mut of_slices, mut alone) = (at_rest, at_rest, damper.at_rest(0.0));
    let [mut forces, mut same] = [[7.0; 19]; 2];
    step_bank(&[damper; 19], &mut of_arrays, &[2e-3; 19], &mut forces);
    let width = VectorWidth::detect();
    step_bank_with(width, &[damper; 17], &mut of_slices, &[2e-3; 18], &mut same);
    let force = damper.step(&mut alone, 2e-3);
    assert_eq!((forces, of_arrays), ([force; 19], [alone; 19]));
    assert_eq!(same[..17], forces[..17]);
    assert_eq!(same[17..], [7.0; 2]);
    assert_eq!(of_slices[17..], at_rest[17..]);
}
