//! Indices and parameters in words with their units. The raw names stay in the rows of a study and in its file.

use dashpot_files::study::{Axis, Sweep, Value, format_number};

use crate::commands::raw_name::in_words;

/// Words of an observed index.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Words {
    /// Quantity with its unit, if it has one.
    pub(super) label: String,
    /// Factor from the value in a row to this unit.
    pub(super) scale: f64,
}

/// Words and factors of the observed indices.
const INDICES: [(&str, &str, f64); 26] = [
    ("sperling_vertical", "vertical ride index", 1.0),
    ("sperling_lateral", "lateral ride index", 1.0),
    (
        "sperling_vertical_first",
        "vertical ride index, first point",
        1.0,
    ),
    (
        "sperling_lateral_first",
        "lateral ride index, first point",
        1.0,
    ),
    ("mean_comfort", "mean comfort N_MV", 1.0),
    (
        "body_vertical_rms_m_per_s2",
        "rms vertical acceleration, m/s²",
        1.0,
    ),
    (
        "body_vertical_greatest_m_per_s2",
        "greatest vertical acceleration, m/s²",
        1.0,
    ),
    (
        "body_lateral_rms_m_per_s2",
        "rms lateral acceleration, m/s²",
        1.0,
    ),
    (
        "body_lateral_greatest_m_per_s2",
        "greatest lateral acceleration, m/s²",
        1.0,
    ),
    (
        "unbalanced_rms_m_per_s2",
        "rms unbalanced acceleration, m/s²",
        1.0,
    ),
    ("derailment_rms", "rms Y/Q", 1.0),
    ("derailment_greatest", "greatest Y/Q", 1.0),
    ("derailment_over_nadal", "Y/Q over Nadal's limit", 1.0),
    ("wear_number_n", "mean wear number, N", 1.0),
    ("wear_number_rms_n", "rms wear number, N", 1.0),
    (
        "max_wear_depth_um_per_1000km",
        "greatest wear depth, µm per 1000 km",
        1.0,
    ),
    ("lateral_force_rms_n", "rms lateral force, kN", 1e-3),
    (
        "lateral_force_greatest_n",
        "greatest lateral force, kN",
        1e-3,
    ),
    (
        "lateral_force_over_limit",
        "lateral force over Prud'homme's limit",
        1.0,
    ),
    ("unloading_greatest", "greatest wheel unloading", 1.0),
    ("wheel_load_greatest_n", "greatest wheel load, kN", 1e-3),
    ("wheel_load_over_limit", "wheel load over its limit", 1.0),
    (
        "wheel_load_over_static",
        "wheel load over that at standstill",
        1.0,
    ),
    ("wheel_lift_longest_s", "longest wheel lift, ms", 1e3),
    ("damper_force_greatest_n", "greatest damper force, kN", 1e-3),
    (
        "last_lateral_m",
        "greatest lateral displacement of the last 3 s, mm",
        1e3,
    ),
];

/// Returns the words of an observed index.
pub(super) fn of_index(name: &str) -> Words {
    let known = INDICES.iter().find(|(known, ..)| *known == name);
    known.map_or_else(
        || Words {
            label: in_words(name),
            scale: 1.0,
        },
        |(_, label, scale)| Words {
            label: (*label).to_owned(),
            scale: *scale,
        },
    )
}

/// Returns the label of an axis; a raw name in place of one as words.
pub(super) fn of_axis(axis: &Axis) -> String {
    if axis.label == axis.parameter {
        in_words(&axis.parameter)
    } else {
        axis.label.clone()
    }
}

/// Formats a value in the unit of the axis.
pub(super) fn in_unit(axis: &Axis, value: &Value) -> String {
    match value {
        Value::Number(number) => format_number(number * axis.factor),
        Value::Word(word) => word.clone(),
    }
}

/// Formats a value with the symbol and the unit of its axis, for the name of a curve.
pub(super) fn equation(axis: &Axis, value: &Value) -> String {
    let Value::Number(_) = value else {
        return value.to_string();
    };
    let label = of_axis(axis);
    let (what, unit) = label.rsplit_once(", ").unwrap_or((&label, ""));
    let symbol = what.rsplit(' ').next().unwrap_or(what);
    let text = format!("{symbol} = {} {unit}", in_unit(axis, value));
    text.trim_end().to_owned()
}

/// Formats a value of the first axis of a sweep, for the name of a curve.
pub(super) fn of_first(sweep: &Sweep, value: &Value) -> String {
    let first = sweep.axes.first();
    first.map_or_else(|| value.to_string(), |axis| equation(axis, value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashpot_study::sweep::OBSERVED;

    #[test]
    fn every_index_has_words_with_the_unit_of_its_name() {
        for index in OBSERVED {
            let words = of_index(index.name);
            assert!(
                INDICES.iter().any(|(name, ..)| *name == index.name),
                "{}",
                index.name
            );
            assert!(!words.label.contains("_n") && !words.label.contains("greatest n"));
            let unit = in_words(index.name);
            let unit = unit.rsplit_once(", ").map(|(_, unit)| unit);
            let expected = match (unit, words.scale) {
                (Some("N"), 1e-3) => "kN",
                (Some("m"), 1e3) => "mm",
                (Some("s"), 1e3) => "ms",
                (Some(unit), 1.0) => unit,
                _ => continue,
            };
            let ends = words.label.ends_with(&format!(", {expected}"));
            assert!(ends, "{}: {}", index.name, words.label);
        }
    }
}
