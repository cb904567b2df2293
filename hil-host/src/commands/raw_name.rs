//! Raw names of signals and parameters in words, for pages. Files and options keep the raw names.

/// Endings of names with their units; longer endings before those that they end in.
const UNITS: [(&str, &str); 16] = [
    ("_m_per_s2", ", m/s²"),
    ("_n_s_per_m", ", N s/m"),
    ("_s_per_m", ", s/m"),
    ("_n_per_m", ", N/m"),
    ("_m_per_s", ", m/s"),
    ("_km_h", ", km/h"),
    ("_rad", ", rad"),
    ("_pa", ", Pa"),
    ("_kg", ", kg"),
    ("_hz", ", Hz"),
    ("_us", ", µs"),
    ("_c", ", °C"),
    ("_m", ", m"),
    ("_n", ", N"),
    ("_s", ", s"),
    ("_derailment", " Y/Q"),
];

/// Returns a raw name of a signal or parameter as words with its unit.
pub(super) fn in_words(name: &str) -> String {
    let found = UNITS
        .into_iter()
        .find_map(|(ending, unit)| Some((name.strip_suffix(ending)?, unit)));
    let (name, unit) = found.unwrap_or((name, ""));
    name.replace(['_', '.'], " ") + unit
}

#[cfg(test)]
mod tests {
    use super::in_words;

    #[test]
    fn a_raw_name_becomes_words_with_a_unit() {
        for (name, words) in [
            ("vertical.mount.clearance_m", "vertical mount clearance, m"),
            ("speed_km_h", "speed, km/h"),
            ("normal_damping_s_per_m", "normal damping, s/m"),
            (
                "lateral.reduced.damping_n_s_per_m",
                "lateral reduced damping, N s/m",
            ),
            ("wheelset_1_left_derailment", "wheelset 1 left Y/Q"),
            ("friction", "friction"),
        ] {
            assert_eq!(in_words(name), words);
        }
    }
}
