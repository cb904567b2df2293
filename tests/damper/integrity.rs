//! Damaged memory: whatever the bits of constants and state, the force is finite and within its limit, and the slow
//! check finds every flipped bit.

use dashpot::damper;
use dashpot::memory::{PlainData, bytes};
use dashpot_core::integrity::{Check, SLICES};
use dashpot_core::parameters::MAX_FORCE_N;
use dashpot_core::{Damper, DamperState, Real, step_bank};
use fastrand::Rng;

/// Number of dampers in the bank: one full group of lanes and some more.
const DAMPERS: usize = 11;

/// Damages all of the memory, some of its values, or one bit.
fn damage(memory: &mut [u8], random: &mut Rng) {
    const UNUSUAL: [u32; 8] = [
        0x7f80_0000,
        0xff80_0000,
        0x7fc0_0000,
        0x7fa0_0000,
        0xffc0_0000,
        0x7f7f_ffff,
        0x8000_0000,
        1,
    ];
    match random.u32(..4) {
        0 => random.fill(memory),
        1 => memory.fill(0xff),
        2 => {
            for _ in 0..random.u32(1..20) {
                let value = UNUSUAL[random.usize(..UNUSUAL.len())];
                let offset = 4 * random.usize(..memory.len() / 4);
                // In a double, the offset is in either half; only the upper half can make it NaN or infinite.
                memory[offset..offset + 4].copy_from_slice(&value.to_le_bytes());
            }
        }
        _ => {
            let bit = random.usize(..8 * memory.len());
            memory[bit / 8] ^= 1 << (bit % 8);
        }
    }
}

fn any_bits_make_a_force_within_its_limit<T: Real>(built: &[Damper<T>], seed: u64)
where
    Damper<T>: PlainData,
    DamperState<T>: PlainData,
{
    let mut random = Rng::with_seed(seed);
    for round in 0..2000 {
        let mut dampers: [Damper<T>; DAMPERS] = std::array::from_fn(|i| built[i % built.len()]);
        let mut states = dampers.map(|damper| damper.at_rest(T::ZERO));
        for (damper, state) in dampers.iter_mut().zip(&mut states) {
            if random.bool() {
                damage(bytes(damper), &mut random);
            }
            if random.bool() {
                let revision = damper.revision();
                damage(bytes(state), &mut random);
                if random.bool() {
                    // The damaged state has this damper's revision, so that the step does not adopt it first.
                    let revision_at = 4 * size_of::<T>();
                    bytes(state)[revision_at..revision_at + 4]
                        .copy_from_slice(&revision.to_ne_bytes());
                }
            }
        }
        for tick in 0..10 {
            let x = std::array::from_fn(|i| {
                let unusual = [f64::NAN, f64::INFINITY, 1e300, -1e300, 0.0];
                let usual = 1e-3 * f64::from(tick) * (i as f64 - 5.0);
                let x = unusual.get(random.usize(..40)).copied().unwrap_or(usual);
                T::from_f64(x)
            });
            let mut forces = [T::ZERO; DAMPERS];
            let mut alone = states;
            step_bank(&dampers.each_ref(), &mut states, &x, &mut forces);
            let pairs = dampers.iter().zip(&mut alone).zip(x).zip(forces);
            for (((damper, state), x), force) in pairs {
                let single = damper.step(state, x);
                let limit = damper.force_limit_n().to_f64();
                assert!(
                    (0.0..=MAX_FORCE_N).contains(&limit),
                    "round {round}: limit {limit}"
                );
                for force in [force, single] {
                    let magnitude = force.to_f64().abs();
                    assert!(
                        magnitude <= limit,
                        "round {round}, tick {tick}: {magnitude} over {limit}"
                    );
                }
            }
        }
    }
}

fn dampers<T: Real>() -> Vec<Damper<T>> {
    let names = ["in-service", "paper", "reduced-vertical"];
    names
        .map(|name| damper(name, &[]).build(1e-3).expect("a preset"))
        .into()
}

#[test]
fn any_bits_make_a_force_within_its_limit_in_f32() {
    any_bits_make_a_force_within_its_limit::<f32>(&dampers(), 1);
}

#[test]
fn any_bits_make_a_force_within_its_limit_in_f64() {
    any_bits_make_a_force_within_its_limit::<f64>(&dampers(), 2);
}

/// Number of calls until the check finds damage, up to two rounds.
fn found_after<T: Real>(damper: &Damper<T>, mut check: Check) -> Option<u32> {
    (1..=2 * SLICES).find(|_| check.slice(damper).is_err())
}

#[test]
fn every_flipped_bit_of_the_constants_is_found() {
    let [mut damper, ..] = dampers::<f32>()[..] else {
        panic!("no preset");
    };
    assert_eq!(found_after(&damper, Check::default()), None);
    // The last values before the table are padding.
    let (meaningless, length) = (56..64, size_of::<Damper<f32>>());
    let mut random = Rng::with_seed(3);
    for bit in (0..8 * length).filter(|bit| !meaningless.contains(&(bit / 8))) {
        // Tests all bits of the scalars, but only a sample of the table's bits.
        if bit > 512 && random.u32(..61) != 0 {
            continue;
        }
        bytes(&mut damper)[bit / 8] ^= 1 << (bit % 8);
        let found = found_after(&damper, Check::default());
        assert!(
            found.is_some_and(|calls| calls <= SLICES),
            "bit {bit}: {found:?}"
        );
        bytes(&mut damper)[bit / 8] ^= 1 << (bit % 8);
    }
}

#[test]
fn a_bit_that_flips_during_a_round_is_found_in_the_next() {
    let mut damper = dampers::<f64>()[0];
    let mut check = Check::default();
    for _ in 0..SLICES / 2 {
        assert_eq!(check.slice(&damper), Ok(()));
    }
    bytes(&mut damper)[2000] ^= 4;
    let found = found_after(&damper, check).expect("it is found");
    assert!(
        found > SLICES / 2 && found <= SLICES / 2 + 1 + SLICES,
        "{found}"
    );
}

#[test]
fn a_change_between_slices_is_not_damage() {
    let [mut damper, other, _] = dampers::<f32>()[..] else {
        panic!("three presets");
    };
    let mut check = Check::default();
    for call in 0..5 * SLICES {
        if call % 100 == 7 {
            damper.set_clearance_m(1e-5 * call as f32).unwrap();
        }
        if call % 777 == 500 {
            damper = if damper == other { dampers()[0] } else { other };
        }
        assert_eq!(check.slice(&damper), Ok(()), "call {call}");
    }
}

#[test]
fn a_state_with_numbers_that_no_step_leaves_is_found() {
    let damper = dampers::<f32>()[0];
    for (offset, value) in [
        (0, f32::NAN),
        (1, f32::NAN),
        (1, 1e3),
        (2, f32::INFINITY),
        (3, 1e6),
        (0, 0.6),
        (0, -1e30),
    ] {
        let mut state = damper.at_rest(0.1);
        bytes(&mut state)[4 * offset..4 * offset + 4].copy_from_slice(&value.to_ne_bytes());
        assert!(
            Check::state(&damper, &state).is_err(),
            "{value} at {offset}"
        );
    }
}
