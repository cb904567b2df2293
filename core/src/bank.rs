//! Steps several dampers in one call, which is faster than one by one and gives bit-identical forces.
//!
//! In one step each operation waits for the result of the previous one. Steps of different dampers are independent, so
//! a bank steps eight dampers together on processors with vector instructions.

use crate::damper::Damper;
use crate::math::group::GROUP;
use crate::real::Real;
use crate::state::DamperState;
use crate::step::step;

/// Steps `N` dampers: `forces[i] = dampers[i].step(&mut states[i], displacements[i])`, bit for bit.
///
/// Displacements (m) and forces (N) have the signs of [`Damper::step`]. The function cannot fail. Several states can
/// share one damper.
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::{Damper, step_bank};
///
/// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
/// let damper: Damper<f64> = parameters.build(1e-3)?;
/// let mut states = [damper.at_rest(0.0); 2];
/// let mut forces = [0.0; 2];
/// for tick in 1..=1000 {
///     let x = 0.02e-3 * f64::from(tick); // 0.02 m/s
///     step_bank(&[&damper; 2], &mut states, &[x, -x], &mut forces);
/// }
/// assert!((forces[0] - 2400.0).abs() < 0.1); // C v
/// assert_eq!(forces[1], -forces[0]);
/// # }
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[inline]
pub fn step_bank<T: Real, const N: usize>(
    dampers: &[&Damper<T>; N],
    states: &mut [DamperState<T>; N],
    displacements: &[T; N],
    forces: &mut [T; N],
) {
    let (dampers, dampers_left) = dampers.as_chunks::<GROUP>();
    let (states, states_left) = states.as_chunks_mut::<GROUP>();
    let (displacements, displacements_left) = displacements.as_chunks::<GROUP>();
    let (forces, forces_left) = forces.as_chunks_mut::<GROUP>();
    let groups = dampers.iter().zip(states).zip(displacements).zip(forces);
    for (((dampers, states), displacements), forces) in groups {
        *forces = step::<T, T::Group, GROUP>(*dampers, states, *displacements);
    }
    let left = dampers_left.iter().zip(states_left).zip(displacements_left);
    for (((damper, state), displacement), force) in left.zip(forces_left) {
        *force = damper.step(state, *displacement);
    }
}

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::step_bank;
    use crate::damper::Damper;
    use crate::math::group::GROUP;
    use crate::real::Real;

    const DAMPERS: usize = GROUP + 3;

    /// Ends that move across the clearance, in contact, beyond the yield force and too fast.
    fn displacements<T: Real>(tick: u32) -> [T; DAMPERS] {
        core::array::from_fn(|index| {
            let (number, t) = (index as f64, 1e-3 * f64::from(tick));
            let slow = 1e-3 * number * libm::sin((5.0 + number) * t);
            T::from_f64(slow + 3e-4 * libm::sin(300.0 * t + number))
        })
    }

    fn compare<T: Real>() {
        let damper: Damper<T> = crate::example::reduced_vertical()
            .build(1e-3)
            .expect("a valid damper");
        let mut states = [damper.at_rest(T::ZERO); DAMPERS];
        let mut expected = states;
        for tick in 1..=1000 {
            let displacements = displacements(tick);
            let mut forces = [T::from_f64(f64::NAN); DAMPERS];
            step_bank(
                &[&damper; DAMPERS],
                &mut states,
                &displacements,
                &mut forces,
            );
            for (index, state) in expected.iter_mut().enumerate() {
                let force = damper.step(state, displacements[index]);
                assert!(forces[index] == force, "damper {index}, tick {tick}");
            }
            assert!(states == expected, "tick {tick}");
        }
    }

    #[test]
    fn a_bank_gives_the_same_states_and_forces_as_single_steps() {
        compare::<f32>();
        compare::<f64>();
    }
}
