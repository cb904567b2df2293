//! Version of the model's behaviour, as a digest of its results.

use super::arithmetic::Arithmetic;

/// First 16 digits of the SHA-256 of the results of short runs with fused multiply-add, on x86-64. A test recomputes
/// and updates both digests (`tests/vehicle_validation/physics.rs`): a change of the model changes them, a change of
/// wording does not.
const FUSED: &str = "8fdf7a2920919a7e";
/// Digest of the same runs without fused multiply-add.
const SEPARATE: &str = "ae0b3419c4732329";

/// Returns the digest of the model's behaviour with an arithmetic. Rows of models that behave differently have
/// different digests.
///
/// ```
/// use dashpot_study::sweep::{Arithmetic, physics};
/// assert_eq!(physics(Arithmetic::here()).len(), 16);
/// assert_ne!(physics(Arithmetic::Fused), physics(Arithmetic::Separate));
/// ```
pub const fn physics(arithmetic: Arithmetic) -> &'static str {
    match arithmetic {
        Arithmetic::Fused => FUSED,
        Arithmetic::Separate => SEPARATE,
    }
}
