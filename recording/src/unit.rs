//! Quantities of channels and their units.

use std::fmt;

/// Quantity that a channel measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Time.
    Time,
    /// Relative displacement of the damper's two ends, positive in extension.
    Displacement,
    /// Force, positive in extension.
    Force,
}

/// A unit of time, length or force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    quantity: Quantity,
    name: &'static str,
    /// Alternative spellings.
    aliases: &'static [&'static str],
    factor: Factor,
}

/// Conversion to SI: the value times `multiplier`, divided by `divisor`. One of the two is 1, so that 0.1 ms is exactly
/// 1e-4 s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factor {
    multiplier: f64,
    divisor: f64,
}

const SI: Factor = times(1.0);

const fn times(multiplier: f64) -> Factor {
    Factor {
        multiplier,
        divisor: 1.0,
    }
}

const fn over(divisor: f64) -> Factor {
    Factor {
        multiplier: 1.0,
        divisor,
    }
}

const fn unit(
    quantity: Quantity,
    name: &'static str,
    aliases: &'static [&'static str],
    factor: Factor,
) -> Unit {
    Unit {
        quantity,
        name,
        aliases,
        factor,
    }
}

/// The prefix micro may be the micro sign (U+00B5) or the Greek letter mu (U+03BC).
const TIMES: [Unit; 5] = [
    unit(Quantity::Time, "s", &["sec", "seconds"], SI),
    unit(Quantity::Time, "ms", &["msec"], over(1e3)),
    unit(
        Quantity::Time,
        "us",
        &["\u{b5}s", "\u{3bc}s", "usec"],
        over(1e6),
    ),
    unit(Quantity::Time, "ns", &[], over(1e9)),
    unit(Quantity::Time, "min", &[], times(60.0)),
];

const LENGTHS: [Unit; 5] = [
    unit(Quantity::Displacement, "m", &[], SI),
    unit(Quantity::Displacement, "cm", &[], over(1e2)),
    unit(Quantity::Displacement, "mm", &[], over(1e3)),
    unit(
        Quantity::Displacement,
        "um",
        &["\u{b5}m", "\u{3bc}m"],
        over(1e6),
    ),
    // International yard and pound agreement (1959): 25.4 mm.
    unit(Quantity::Displacement, "in", &["inch", "\""], times(0.0254)),
];

const FORCES: [Unit; 5] = [
    unit(Quantity::Force, "N", &[], SI),
    unit(Quantity::Force, "daN", &[], times(10.0)),
    unit(Quantity::Force, "kN", &[], times(1e3)),
    unit(Quantity::Force, "MN", &[], times(1e6)),
    // Pound of the same agreement (0.45359237 kg) at standard gravity (9.80665 m/s2).
    unit(
        Quantity::Force,
        "lbf",
        &["lb", "lbs"],
        times(4.448_221_615_260_5),
    ),
];

/// Endings of channel names that state the unit. `in` and `min` are not included because they are also words.
const ENDINGS: [(&str, &str); 8] = [
    ("_s", "s"),
    ("_ms", "ms"),
    ("_us", "us"),
    ("_m", "m"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_n", "N"),
    ("_kn", "kN"),
];

impl Quantity {
    /// Name of the quantity.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Displacement => "displacement",
            Self::Force => "force",
        }
    }

    /// Name of the SI channel as Dashpot writes it, with the unit.
    pub fn column(self) -> &'static str {
        match self {
            Self::Time => "time_s",
            Self::Displacement => "displacement_m",
            Self::Force => "force_n",
        }
    }

    /// Known units; the SI unit is first.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Self::Time => &TIMES,
            Self::Displacement => &LENGTHS,
            Self::Force => &FORCES,
        }
    }

    /// Names of the known units for messages.
    pub fn unit_names(self) -> String {
        let names: Vec<&str> = self.units().iter().map(|unit| unit.name).collect();
        names.join(", ")
    }

    /// Returns the unit with this name or alias.
    pub fn unit(self, text: &str) -> Option<Unit> {
        let named = |unit: &&Unit| unit.name == text || unit.aliases.contains(&text);
        self.units().iter().find(named).copied()
    }

    /// Returns the unit at the end of a channel name such as `force_kn`.
    pub fn unit_in_name(self, name: &str) -> Option<Unit> {
        let lower = name.to_ascii_lowercase();
        let (_, unit) = ENDINGS.iter().find(|(ending, unit)| {
            lower.ends_with(ending) && lower.len() > ending.len() && self.unit(unit).is_some()
        })?;
        self.unit(unit)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Unit {
    /// Name of the unit.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Quantity that the unit measures.
    pub fn quantity(self) -> Quantity {
        self.quantity
    }

    /// Converts a value in this unit to SI.
    #[inline]
    pub fn to_si(self, number: f64) -> f64 {
        number * self.factor.multiplier / self.factor.divisor
    }
}
