//! Variables of an FMU.

/// A variable; value references count from 1 on in the order of the list, 0 is the time.
pub(super) struct Variable {
    pub name: String,
    /// One of [`UNITS`]; empty where it has none.
    pub unit: &'static str,
    pub description: &'static str,
    pub kind: Kind,
}

/// Causality, variability and how a variable begins.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Input,
    Output,
    Tunable { start: f64, greatest: f64 },
    Counter,
}

/// Units in words of SI.
pub(super) const UNITS: [(&str, &str); 5] = [
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
    ("m/s2", r#"m="1" s="-2""#),
    ("rad", r#"rad="1""#),
    ("N", r#"kg="1" m="1" s="-2""#),
];
