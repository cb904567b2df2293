//! Version of the model's behaviour, as a digest of its results.

/// First 16 digits of the SHA-256 of the results of short runs. Rows of models that behave differently have different
/// digests. A test recomputes and updates it (`tests/vehicle_validation/physics.rs`): a change of the model changes it,
/// a change of wording or another processor does not.
///
/// ```
/// assert_eq!(dashpot_study::sweep::PHYSICS.len(), 16);
/// ```
pub const PHYSICS: &str = "5e94a4874684b433";
