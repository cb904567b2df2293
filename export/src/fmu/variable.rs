//! Variables of an FMU.

/// Variable of an FMU. Value references count from 1 in the order of the list; 0 is the time.
pub(super) struct Variable {
    pub name: String,
    /// One of [`UNITS`]; empty if dimensionless.
    pub unit: &'static str,
    pub description: &'static str,
    pub kind: Kind,
}

/// Causality and variability of a variable, with its start value.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Input { start: f64 },
    Output,
    Tunable { start: f64, max: f64 },
    Counter,
}

/// Units with their SI base units.
pub(super) const UNITS: [(&str, &str); 6] = [
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
    ("m/s2", r#"m="1" s="-2""#),
    ("rad", r#"rad="1""#),
    ("N", r#"kg="1" m="1" s="-2""#),
    ("N.m", r#"kg="1" m="2" s="-2""#),
];
