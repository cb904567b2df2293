//! Variables of an FMU.

/// Variable of an FMU. Value references count from 1 in the order of the list; 0 is the time, which FMI 2 does not
/// list.
pub(super) struct Variable {
    pub name: String,
    /// Name of one of [`UNITS`]; empty if dimensionless.
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

/// A unit.
pub(super) struct Unit {
    pub name: &'static str,
    /// SI base units, as attributes.
    pub base: &'static str,
    /// Unit in which tools show values, and how many of it make one of this unit.
    pub display: Option<(&'static str, &'static str)>,
    /// Usual size of a variable with this unit, for the tolerances of importers.
    pub nominal: &'static str,
}

const fn unit(
    name: &'static str,
    base: &'static str,
    display: Option<(&'static str, &'static str)>,
    nominal: &'static str,
) -> Unit {
    Unit {
        name,
        base,
        display,
        nominal,
    }
}

/// Units of all variables.
pub(super) const UNITS: [Unit; 6] = [
    unit("m", r#"m="1""#, Some(("mm", "1000")), "0.01"),
    unit("m/s", r#"m="1" s="-1""#, None, "0.1"),
    unit("m/s2", r#"m="1" s="-2""#, None, "1"),
    unit(
        "rad",
        r#"rad="1""#,
        Some(("deg", "57.29577951308232")),
        "0.01",
    ),
    unit(
        "N",
        r#"kg="1" m="1" s="-2""#,
        Some(("kN", "0.001")),
        "10000",
    ),
    unit(
        "N.m",
        r#"kg="1" m="2" s="-2""#,
        Some(("kN.m", "0.001")),
        "10000",
    ),
];
