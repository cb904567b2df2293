//! A state as plain bytes, for messages that have their own checksum.

use super::saved_state::SavedStateError;
use crate::damper::Damper;
use crate::state::DamperState;
use crate::status::Status;

macro_rules! state_bytes {
    ($float:ident, $bytes:literal) => {
        impl DamperState<$float> {
            /// Number of bytes of a state.
            pub const BYTES: usize = $bytes;

            /// Returns this state as plain little-endian bytes: displacement, stretch, flow potential, force, then
            /// revision (4 bytes), status bits (2) and rejected inputs (2).
            pub fn to_bytes(&self) -> [u8; $bytes] {
                let reals = [self.displacement, self.stretch, self.potential, self.force];
                let reals = reals.into_iter().flat_map($float::to_le_bytes);
                let bytes = reals
                    .chain(self.revision.to_le_bytes())
                    .chain(self.status().bits().to_le_bytes())
                    .chain(self.rejected_inputs.to_le_bytes());
                let mut saved = [0; $bytes];
                for (to, byte) in saved.iter_mut().zip(bytes) {
                    *to = byte;
                }
                saved
            }
        }

        impl Damper<$float> {
            /// Restores the state of [`DamperState::to_bytes`] bit for bit.
            ///
            /// # Errors
            /// The state belongs to another damper, or a number cannot result from a step of this damper.
            ///
            /// ```
            /// # #[cfg(feature = "builder")] {
            /// use dashpot_core::parameters::{DamperParameters, Mount};
            /// use dashpot_core::{Damper, SavedStateError};
            ///
            /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
            #[doc = concat!("let damper: Damper<", stringify!($float), "> = parameters.build(1e-3)?;")]
            /// let mut bytes = damper.at_rest(0.25).to_bytes();
            /// assert_eq!(damper.state_from_bytes(&bytes).unwrap().displacement_m(), 0.25);
            #[doc = concat!("let revision = &mut bytes[", stringify!($bytes), " - 8..][..4];")]
            /// revision.copy_from_slice(&7_u32.to_le_bytes());
            /// let refused = SavedStateError::Revision { expected: damper.revision(), found: 7 };
            /// assert_eq!(damper.state_from_bytes(&bytes), Err(refused));
            /// # }
            /// # Ok::<(), dashpot_core::BuildError>(())
            /// ```
            pub fn state_from_bytes(&self, bytes: &[u8; $bytes]) -> Result<DamperState<$float>, SavedStateError> {
                const REAL: usize = size_of::<$float>();
                let (reals, _) = bytes.as_chunks::<REAL>();
                let [displacement, stretch, potential, force, ..] = *reals else {
                    return Err(SavedStateError::Values);
                };
                let [.., r0, r1, r2, r3, s0, s1, n0, n1] = *bytes;
                let state = DamperState::new(
                    [displacement, stretch, potential, force].map($float::from_le_bytes),
                    u32::from_le_bytes([r0, r1, r2, r3]),
                    Status::from_bits_truncate(u16::from_le_bytes([s0, s1])),
                    u16::from_le_bytes([n0, n1]),
                );
                if state.revision != self.revision {
                    return Err(SavedStateError::Revision {
                        expected: self.revision,
                        found: state.revision,
                    });
                }
                if self.could_leave(&state) { Ok(state) } else { Err(SavedStateError::Values) }
            }
        }
    };
}

state_bytes!(f32, 24);
state_bytes!(f64, 40);

#[cfg(test)]
mod tests {
    use super::SavedStateError;
    use crate::Damper;

    #[cfg(feature = "builder")]
    fn damper() -> Damper<f32> {
        crate::example::reduced_vertical().build(1e-3).unwrap()
    }

    #[cfg(feature = "builder")]
    #[test]
    fn a_restored_state_steps_identically() {
        let damper = damper();
        let mut state = damper.at_rest(0.0);
        for tick in 0..500 {
            // Up to 0.3 m/s, ten times the saturation velocity, and one step that is too fast to follow.
            let x = 0.01 * (0.03 * tick as f32).sin() + if tick == 250 { 5.0 } else { 0.0 };
            let mut restored = damper.state_from_bytes(&state.to_bytes()).unwrap();
            assert_eq!(restored, state);
            let force = damper.step(&mut state, x);
            assert_eq!(damper.step(&mut restored, x).to_bits(), force.to_bits());
        }
        assert!(state.rejected_inputs() > 0);
    }

    #[cfg(feature = "builder")]
    #[test]
    fn impossible_values_are_refused() {
        let damper = damper();
        let state = damper.at_rest(0.0);
        for (offset, value) in [
            (0, f32::NAN),
            (0, f32::INFINITY),
            (4, 1.0),
            (4, f32::NAN),
            (8, f32::NEG_INFINITY),
            (12, 3700.0),
            (12, f32::NAN),
        ] {
            let mut bytes = state.to_bytes();
            bytes[offset..offset + 4].copy_from_slice(&value.to_le_bytes());
            let refused = damper.state_from_bytes(&bytes);
            assert_eq!(refused, Err(SavedStateError::Values), "{value} at {offset}");
        }
    }
}
