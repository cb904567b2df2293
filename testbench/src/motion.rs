//! Steps a damper, or a bank of dampers, through a motion held in memory; the result is bit-identical to stepping tick
//! by tick.

use dashpot_core::{Damper, DamperState, Real, VectorWidth, step_bank_with};

/// Ticks between two checks for cancellation.
const TICKS_PER_CHECK: usize = 1 << 16;

/// Steps of single dampers that take the time of a bank's step per damper.
const STEPS_PER_BANK_STEP: usize = 8;

/// Steps `damper` through `displacements` (m) and writes the forces (N); returns false if cancelled.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::motion;
/// let damper = damper::load("paper", &[])?.build::<f64>(1e-3)?;
/// let (mut state, mut forces) = (damper.at_rest(0.0), [0.0; 3]);
/// assert!(motion::follow(&damper, &mut state, &[1e-4, 2e-4, 3e-4], &mut forces, &|| false));
/// assert_eq!(forces[2], state.force_n());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn follow<T: Real>(
    damper: &Damper<T>,
    state: &mut DamperState<T>,
    displacements: &[T],
    forces: &mut [T],
    is_cancelled: &dyn Fn() -> bool,
) -> bool {
    let parts = displacements.chunks(TICKS_PER_CHECK);
    for (displacements, forces) in parts.zip(forces.chunks_mut(TICKS_PER_CHECK)) {
        if is_cancelled() {
            return false;
        }
        for (displacement, force) in displacements.iter().zip(forces) {
            *force = damper.step(state, *displacement);
        }
    }
    true
}

/// Same as [`follow`], but for a bank: each tick is a row with one displacement and one force per damper.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::motion;
/// let damper = damper::load("paper", &[])?.build::<f64>(1e-3)?;
/// let (mut states, mut forces) = ([damper.at_rest(0.0); 2], [0.0; 4]);
/// let ticks = [1e-4, -1e-4, 2e-4, -2e-4];
/// assert!(motion::follow_bank(&[&damper; 2], &mut states, &ticks, &mut forces, &|| false));
/// let mut alone = damper.at_rest(0.0);
/// assert_eq!(damper.step(&mut alone, 1e-4), forces[0]);
/// assert_eq!(damper.step(&mut alone, 2e-4), forces[2]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn follow_bank<T: Real>(
    dampers: &[&Damper<T>],
    states: &mut [DamperState<T>],
    displacements: &[T],
    forces: &mut [T],
    is_cancelled: &dyn Fn() -> bool,
) -> bool {
    let width = VectorWidth::detect();
    let count = dampers.len().max(1);
    let rows = displacements.chunks_exact(count);
    for (tick, (displacements, forces)) in rows.zip(forces.chunks_exact_mut(count)).enumerate() {
        if tick.is_multiple_of(TICKS_PER_CHECK / STEPS_PER_BANK_STEP) && is_cancelled() {
            return false;
        }
        step_bank_with(width, dampers, states, displacements, forces);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashpot_files::damper;

    #[test]
    fn banks_of_any_size_match_single_dampers_bit_for_bit() {
        let built = ["paper", "in-service", "reduced-lateral"].map(|name| {
            let damper = damper::load(name, &[]).unwrap();
            damper.build::<f32>(1e-3).unwrap()
        });
        for count in [1, 7, 8, 19] {
            let dampers: Vec<&Damper<f32>> = built.iter().cycle().take(count).collect();
            let mut states: Vec<_> = dampers.iter().map(|damper| damper.at_rest(0.0)).collect();
            let mut alone = states.clone();
            let x =
                |tick: usize, slot: usize| 5e-3 * (0.01 * tick as f32 * (1.0 + slot as f32)).sin();
            let cells = (0..500).flat_map(|tick| (0..count).map(move |slot| x(tick, slot)));
            let displacements: Vec<f32> = cells.collect();
            let mut forces = vec![0.0; displacements.len()];
            assert!(follow_bank(
                &dampers,
                &mut states,
                &displacements,
                &mut forces,
                &|| false
            ));
            for (slot, damper) in dampers.iter().enumerate() {
                let column: Vec<f32> = (0..500).map(|tick| x(tick, slot)).collect();
                let mut singles = vec![0.0; 500];
                assert!(follow(
                    damper,
                    &mut alone[slot],
                    &column,
                    &mut singles,
                    &|| false
                ));
                for (tick, force) in singles.iter().enumerate() {
                    assert_eq!(force.to_bits(), forces[tick * count + slot].to_bits());
                }
            }
            assert_eq!(states, alone);
        }
    }

    #[test]
    fn cancellation_stops_the_motion() {
        let damper = damper::load("paper", &[]).unwrap().build(1e-3).unwrap();
        let (mut state, mut forces) = (damper.at_rest(0.0), [7.0_f32; 2]);
        assert!(!follow(
            &damper,
            &mut state,
            &[1e-3; 2],
            &mut forces,
            &|| true
        ));
        let ended = follow_bank(&[&damper], &mut [state], &[1e-3; 2], &mut forces, &|| true);
        assert!(!ended);
        assert_eq!(forces, [7.0; 2]);
    }
}
