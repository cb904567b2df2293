//! Steps several dampers in one call, which is faster than one by one and gives bit-identical forces.
//!
//! In one step each operation waits for the result of the previous one. Steps of different dampers are independent, so
//! a bank steps eight dampers together on processors with vector instructions.

use crate::damper::Damper;
use crate::real::Real;
use crate::state::DamperState;

#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
mod group;
mod width;

pub use width::VectorWidth;

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
    step_bank_with(
        VectorWidth::baseline(),
        dampers,
        states,
        displacements,
        forces,
    );
}

/// Does the same as [`step_bank`] in vectors of the given width, for slices. The bits do not depend on the width.
///
/// If the slices have different lengths, the shortest one counts.
#[inline]
pub fn step_bank_with<T: Real>(
    width: VectorWidth,
    dampers: &[&Damper<T>],
    states: &mut [DamperState<T>],
    displacements: &[T],
    forces: &mut [T],
) {
    let bank = Bank::new(dampers, states, displacements, forces);
    width.step(bank).step_one_by_one();
}

/// Dampers to step, with their states, displacements (m) and forces (N): slices of one length.
pub(crate) struct Bank<'a, T> {
    dampers: &'a [&'a Damper<T>],
    states: &'a mut [DamperState<T>],
    displacements: &'a [T],
    forces: &'a mut [T],
}

impl<'a, T: Real> Bank<'a, T> {
    #[inline(always)]
    fn new(
        dampers: &'a [&'a Damper<T>],
        states: &'a mut [DamperState<T>],
        displacements: &'a [T],
        forces: &'a mut [T],
    ) -> Self {
        let count = dampers.len().min(states.len());
        let count = count.min(displacements.len()).min(forces.len());
        Self {
            dampers: dampers.get(..count).unwrap_or_default(),
            states: states.get_mut(..count).unwrap_or_default(),
            displacements: displacements.get(..count).unwrap_or_default(),
            forces: forces.get_mut(..count).unwrap_or_default(),
        }
    }

    #[inline(always)]
    fn step_one_by_one(self) {
        let lanes = self.dampers.iter().zip(self.states).zip(self.displacements);
        for (((damper, state), displacement), force) in lanes.zip(self.forces) {
            *force = damper.step(state, *displacement);
        }
    }
}

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::step_bank;
    use crate::damper::Damper;
    use crate::real::Real;

    const DAMPERS: usize = 11;

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
