//! Names of signals in words.

use serde::Serialize;

/// A signal's name, its words and its unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignalWords {
    name: String,
    label: String,
    unit: &'static str,
}

/// Endings of names, their words and their units. The first that fits counts.
const ENDINGS: [(&str, &str, &str); 17] = [
    (
        "_filtered_lateral_force_n",
        "lateral force, 20 Hz, mean over 2 m",
        "N",
    ),
    ("_filtered_derailment", "Y/Q, 20 Hz, mean over 2 m", "1"),
    ("_filtered_load_n", "wheel load, 20 Hz", "N"),
    (
        "_lateral_acceleration_m_per_s2",
        "lateral acceleration",
        "m/s²",
    ),
    (
        "_vertical_acceleration_m_per_s2",
        "vertical acceleration",
        "m/s²",
    ),
    ("_velocity_m_per_s", "velocity", "m/s"),
    ("_displacement_m", "displacement", "m"),
    ("_lateral_m", "lateral displacement", "m"),
    ("_vertical_m", "vertical displacement", "m"),
    ("_roll_rad", "roll", "rad"),
    ("_pitch_rad", "pitch", "rad"),
    ("_yaw_rad", "yaw", "rad"),
    ("_lateral_n", "lateral force Y", "N"),
    ("_load_n", "wheel load Q", "N"),
    ("_derailment", "Y/Q", "1"),
    ("_contact_m", "contact on the wheel", "m"),
    ("_force_n", "force", "N"),
];

impl SignalWords {
    /// Returns the words of a signal by its name in a history.
    ///
    /// ```
    /// let words = dashpot_live::SignalWords::of("wheelset_1_left_load_n");
    /// assert_eq!(words.label(), "wheelset 1 left: wheel load Q");
    /// assert_eq!(words.unit(), "N");
    /// ```
    pub fn of(name: &str) -> Self {
        let found = ENDINGS.iter().find_map(|(ending, words, unit)| {
            let of = name.strip_suffix(ending)?.replace('_', " ");
            Some((format!("{of}: {words}"), *unit))
        });
        let (label, unit) = found.unwrap_or_else(|| match name {
            "time_s" => ("time".into(), "s"),
            "distance_m" => ("distance".into(), "m"),
            other => (other.replace('_', " "), "1"),
        });
        Self {
            name: name.to_owned(),
            label,
            unit,
        }
    }

    /// Name in words.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Unit; `1` without one.
    pub fn unit(&self) -> &'static str {
        self.unit
    }
}
