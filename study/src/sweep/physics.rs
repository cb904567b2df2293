//! The behaviour of the model that this program computes rows with.

use super::arithmetic::Arithmetic;

/// SHA-256, its first 16 digits, of the results of short runs with fused multiplication and without, on x86-64. A test
/// recomputes and writes them (`tests/vehicle_validation/physics.rs`): a change of the model changes them, a change
/// of words does not.
const FUSED: &str = "71834a405a4c2785";
const SEPARATE: &str = "a78fe964214d5a97";

/// What tells rows of different physics apart: the digest of the model's behaviour with an arithmetic.
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
