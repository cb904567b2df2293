//! Status bits of a hybrid test in words.

use dashpot_core::hybrid::HybridStatus;

/// Each status bit in words.
const WORDS: [(HybridStatus, &str); 12] = [
    (
        HybridStatus::COMMAND_LIMITED,
        "the rate of the command was limited",
    ),
    (HybridStatus::MEASUREMENT_MISSED, "readings were missing"),
    (HybridStatus::STROKE, "the command was beyond the stroke"),
    (
        HybridStatus::VELOCITY,
        "the rate of the command was limited for too long",
    ),
    (HybridStatus::FORCE, "the force was beyond its limit"),
    (
        HybridStatus::TRACKING,
        "measured and desired displacement were too far apart for too long",
    ),
    (HybridStatus::AGE, "no reading came for too long"),
    (
        HybridStatus::IMPLAUSIBLE,
        "a reading jumped, froze or was not a number",
    ),
    (
        HybridStatus::SIGN,
        "the force pushed in the direction of the motion",
    ),
    (
        HybridStatus::ENERGY,
        "the actuator added too much energy to the vehicle",
    ),
    (HybridStatus::REQUESTED, "the end was requested"),
    (
        HybridStatus::NO_FORCE,
        "the specimen moved far without a force",
    ),
];

/// Returns the words for the bits that are set.
pub(in crate::commands) fn reasons(status: HybridStatus) -> Vec<&'static str> {
    let set = WORDS.iter().filter(|(bit, _)| status.contains(*bit));
    set.map(|(_, words)| *words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_has_words() {
        for (name, bit) in HybridStatus::all().iter_names() {
            assert_eq!(reasons(bit).len(), 1, "{name}");
        }
    }
}
