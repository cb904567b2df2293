//! Flips each bit of a running state, one at a time, at several moments. A value that no step produces must restart the
//! damper at rest in the same tick and set a status bit. docs/numerics.md lists the resulting force error and its
//! duration.

use std::f64::consts::TAU;
use std::fmt::Write;

use dashpot::memory::{PlainData, bytes};
use dashpot::random_damper::{self, Random};
use dashpot::{damper, document};
use dashpot_core::integrity::Check;
use dashpot_core::parameters::DamperParameters;
use dashpot_core::{Damper, DamperState, Real, Status};

const STEP_S: f64 = 1e-3;
const PRESETS: [&str; 5] = [
    "paper",
    "calibrated",
    "reduced-vertical",
    "reduced-lateral",
    "in-service",
];
/// Ticks at which a bit is flipped.
const MOMENTS: [u32; 7] = [60, 131, 202, 273, 344, 415, 486];
/// Number of ticks compared afterwards.
const COMPARED: u32 = 400;
/// A force is right if its error is below this fraction of the force limit.
const RIGHT: f64 = 0.01;
/// Names of the values of a state, and of the words after them.
const PARTS: [&str; 6] = [
    "displacement",
    "stretch",
    "flow potential",
    "force",
    "revision",
    "status, mark and counter",
];

/// Effect of flipping bits of one value.
#[derive(Clone, Copy, Default)]
struct Effect {
    flips: u32,
    started_over: u32,
    /// Largest difference of the force over the force limit.
    worst: f64,
    /// Maximum number of ticks until the force was right again and stayed right.
    longest: u32,
}

/// Displacement (m) at a tick; the speed is at most 0.22 m/s.
fn displacement<T: Real>(tick: u32) -> T {
    let t = STEP_S * f64::from(tick);
    let wave =
        |amplitude_m: f64, frequency_hz: f64| amplitude_m * libm::sin(TAU * frequency_hz * t);
    T::from_f64(wave(8e-3, 2.3) + wave(1e-3, 17.0))
}

/// Steps an undamaged state and one with a flipped bit in parallel.
fn compare<T: Real>(
    damper: &Damper<T>,
    tick: u32,
    (sound, flipped): (DamperState<T>, DamperState<T>),
    bit: usize,
    effect: &mut Effect,
) where
    DamperState<T>: PlainData,
{
    let number = bit / (8 * size_of::<T>());
    let limit = damper.force_limit_n().to_f64();
    let is_impossible = Check::state(damper, &flipped).is_err();
    let (mut sound, mut flipped) = (sound, flipped);
    effect.flips += 1;
    for later in 0..COMPARED {
        let x = displacement(tick + later);
        let expected = damper.step(&mut sound, x).to_f64();
        let force = damper.step(&mut flipped, x).to_f64();
        let off = (force - expected).abs() / limit;
        assert!(force.abs() <= limit, "bit {bit}: {force} N");
        if later == 0 {
            let started_over = flipped.status().contains(Status::CORRUPTED)
                && !sound.status().contains(Status::CORRUPTED);
            // The step recomputes the flow potential and does not use the last force.
            if is_impossible && number < 2 {
                assert!(started_over, "tick {tick}, bit {bit}: {flipped:?}");
            }
            effect.started_over += u32::from(started_over && number < 4);
            assert_eq!(
                Check::state(damper, &unmarked(flipped)),
                Ok(()),
                "bit {bit}"
            );
        }
        effect.worst = effect.worst.max(off);
        if off > RIGHT {
            effect.longest = effect.longest.max(later + 1);
        }
        let has_forgotten = flipped.displacement_m() == sound.displacement_m()
            && flipped.piston_displacement_m() == sound.piston_displacement_m();
        if has_forgotten && later > 1 {
            return;
        }
    }
}

/// The state with a valid mark and without status, so that only its values matter.
fn unmarked<T: Real>(state: DamperState<T>) -> DamperState<T>
where
    DamperState<T>: PlainData,
{
    let (mut state, mut made) = (state, DamperState::<T>::default());
    let word = 4 * size_of::<T>() + 4;
    bytes(&mut state)[word..].copy_from_slice(&bytes(&mut made)[word..]);
    state
}

fn flip_every_bit<T: Real>(parameters: &DamperParameters, effects: &mut [Effect; PARTS.len()])
where
    DamperState<T>: PlainData,
{
    let damper: Damper<T> = parameters.build(STEP_S).expect("a valid damper");
    let mut state = damper.at_rest(displacement(0));
    for tick in 1..=MOMENTS[MOMENTS.len() - 1] {
        if MOMENTS.contains(&tick) {
            let revision_at = 32 * size_of::<T>();
            for bit in 0..8 * size_of::<DamperState<T>>() {
                let part = match bit {
                    bit if bit < revision_at => bit / (8 * size_of::<T>()),
                    bit if bit < revision_at + 32 => 4,
                    _ => 5,
                };
                let mut flipped = state;
                bytes(&mut flipped)[bit / 8] ^= 1 << (bit % 8);
                compare(&damper, tick, (state, flipped), bit, &mut effects[part]);
            }
        }
        damper.step(&mut state, displacement(tick));
    }
}

fn effects(all: impl Iterator<Item = DamperParameters>) -> [Effect; PARTS.len()] {
    let mut effects = [Effect::default(); PARTS.len()];
    for parameters in all {
        flip_every_bit::<f32>(&parameters, &mut effects);
        flip_every_bit::<f64>(&parameters, &mut effects);
    }
    effects
}

#[test]
fn the_effect_of_a_flipped_bit_ends_and_is_reported_if_possible() {
    let presets = effects(PRESETS.iter().map(|name| damper(name, &[])));
    let random = effects((0..8).map(|seed| random_damper::damper(&mut Random(seed))));
    let mut table = String::from(
        "| field | dampers | flips | restarts at rest | largest error, % of the force limit | \
         time until within 1 %, ms |\n\
         |---|---|---|---|---|---|\n",
    );
    for (part, name) in PARTS.iter().enumerate() {
        for (dampers, effects) in [("presets", &presets), ("random", &random)] {
            let Effect {
                flips,
                started_over,
                worst,
                longest,
            } = effects[part];
            writeln!(
                table,
                "| {name} | {dampers} | {flips} | {started_over} | {:.1} | {longest} |",
                100.0 * worst
            )
            .expect("text grows");
        }
    }
    document::compare_part("docs/numerics.md", "flipped bits", &table);
    for part in [3, 5] {
        for effects in [&presets, &random] {
            assert_eq!(effects[part].worst, 0.0, "{}", PARTS[part]);
        }
    }
}
