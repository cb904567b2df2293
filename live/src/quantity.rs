//! Numbers of a damper that an operator changes.

use dashpot_files::damper::{KeyedParameters, range};
use serde::Serialize;

/// Key of the wear, which changes several numbers.
pub(crate) const WEAR: &str = "wear";

/// A number that an operator changes, with its range on the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quantity {
    /// Key in a damper file, or `wear`.
    pub key: &'static str,
    /// In words.
    pub label: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Smallest value of the slider.
    pub min: f64,
    /// Largest value of the slider.
    pub max: f64,
    /// Value as new.
    pub value: f64,
    /// True if equal factors are equal distances on the slider.
    pub is_logarithmic: bool,
}

/// Range of a slider.
enum Slider {
    /// From the smallest to the largest value.
    Linear(f64, f64),
    /// These shares of the value as new.
    Factors(f64, f64),
}

/// Key, words, unit and range of each number.
const QUANTITIES: [(&str, &str, &str, Slider); 9] = [
    (
        "mount.clearance_m",
        "clearance 2a",
        "m",
        Slider::Linear(0.0, 0.02),
    ),
    (
        "mount.stiffness_n_per_m",
        "stiffness of rubber",
        "N/m",
        Slider::Factors(0.02, 5.0),
    ),
    (
        "reduced.damping_n_s_per_m",
        "damping",
        "N s/m",
        Slider::Factors(0.02, 5.0),
    ),
    (
        "reduced.saturation_velocity_m_per_s",
        "saturation velocity",
        "m/s",
        Slider::Factors(0.1, 10.0),
    ),
    (
        "oil.temperature_c",
        "temperature of the oil",
        "°C",
        Slider::Linear(-40.0, 100.0),
    ),
    (
        "oil.column.air_fraction",
        "air in the oil",
        "1",
        Slider::Linear(0.0, 0.1),
    ),
    (
        "orifice.diameter_m",
        "diameter of the orifice",
        "m",
        Slider::Factors(0.3, 3.0),
    ),
    (
        "leakage.radial_clearance_m",
        "clearance of the piston",
        "m",
        Slider::Linear(0.0, 3e-4),
    ),
    (
        "seal.friction_n",
        "friction of the seal",
        "N",
        Slider::Linear(0.0, 1000.0),
    ),
];

/// Numbers at full wear, from those as new: our choice, about twice the worst in service.
const WORN_OUT: [(&str, f64, f64); 4] = [
    ("mount.clearance_m", 1.0, 5e-3),
    ("mount.stiffness_n_per_m", 0.4, 0.0),
    ("reduced.damping_n_s_per_m", 0.4, 0.0),
    ("leakage.radial_clearance_m", 1.0, 1.5e-4),
];

/// Returns the numbers of a damper as new that an operator changes.
pub(crate) fn of_damper(as_new: &KeyedParameters) -> Vec<Quantity> {
    let wear = Quantity {
        key: WEAR,
        label: "wear, from as new to worn out",
        unit: "1",
        min: 0.0,
        max: 1.0,
        value: 0.0,
        is_logarithmic: false,
    };
    let numbers = QUANTITIES.iter().filter_map(|(key, label, unit, slider)| {
        let value = as_new.number(key).ok()?;
        let allowed = range(key)?;
        let (min, max, is_logarithmic) = match slider {
            Slider::Linear(min, max) => (*min, *max, false),
            Slider::Factors(min, max) => (min * value, max * value, true),
        };
        Some(Quantity {
            key,
            label,
            unit,
            min: min.max(allowed.min),
            max: max.max(value).min(allowed.max),
            value,
            is_logarithmic,
        })
    });
    std::iter::once(wear).chain(numbers).collect()
}

/// Returns the numbers of a damper that is worn by a share from 0 to 1.
pub(crate) fn worn(as_new: &KeyedParameters, share: f64) -> Vec<(&'static str, f64)> {
    let numbers = WORN_OUT.iter();
    numbers
        .filter_map(|(key, factor, more)| {
            let value = as_new.number(key).ok()?;
            let worn_out = factor * value + more;
            Some((*key, value + share * (worn_out - value)))
        })
        .collect()
}
