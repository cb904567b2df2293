//! What a channel measures, and the units that it may have in a file.

use std::fmt;

/// What a channel of a recording measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Time.
    Time,
    /// Relative displacement of the seats, positive in extension.
    Displacement,
    /// Force, positive in extension.
    Force,
}

/// A unit of time, length or force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    quantity: Quantity,
    name: &'static str,
    /// Other spellings.
    others: &'static [&'static str],
    /// SI is the number times the first over the second: one of the two is 1, so that 0.1 ms are 1e-4 s to the bit.
    factor: [f64; 2],
}

const fn unit(
    quantity: Quantity,
    name: &'static str,
    others: &'static [&'static str],
    factor: [f64; 2],
) -> Unit {
    Unit {
        quantity,
        name,
        others,
        factor,
    }
}

/// Micro is the sign of its own (U+00B5) or the Greek letter.
const TIMES: [Unit; 5] = [
    unit(Quantity::Time, "s", &["sec", "seconds"], [1.0, 1.0]),
    unit(Quantity::Time, "ms", &["msec"], [1.0, 1e3]),
    unit(
        Quantity::Time,
        "us",
        &["\u{b5}s", "\u{3bc}s", "usec"],
        [1.0, 1e6],
    ),
    unit(Quantity::Time, "ns", &[], [1.0, 1e9]),
    unit(Quantity::Time, "min", &[], [60.0, 1.0]),
];

const LENGTHS: [Unit; 5] = [
    unit(Quantity::Displacement, "m", &[], [1.0, 1.0]),
    unit(Quantity::Displacement, "cm", &[], [1.0, 1e2]),
    unit(Quantity::Displacement, "mm", &[], [1.0, 1e3]),
    unit(
        Quantity::Displacement,
        "um",
        &["\u{b5}m", "\u{3bc}m"],
        [1.0, 1e6],
    ),
    // International yard and pound agreement, 1959: 25.4 mm.
    unit(Quantity::Displacement, "in", &["inch", "\""], [0.0254, 1.0]),
];

const FORCES: [Unit; 5] = [
    unit(Quantity::Force, "N", &[], [1.0, 1.0]),
    unit(Quantity::Force, "daN", &[], [10.0, 1.0]),
    unit(Quantity::Force, "kN", &[], [1e3, 1.0]),
    unit(Quantity::Force, "MN", &[], [1e6, 1.0]),
    // The pound of the agreement at standard gravity: 0.45359237 kg, 9.80665 m/s2.
    unit(
        Quantity::Force,
        "lbf",
        &["lb", "lbs"],
        [4.448_221_615_260_5, 1.0],
    ),
];

/// Names of channels that end so tell their unit. Not `in` and `min`, which are words too.
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
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Displacement => "displacement",
            Self::Force => "force",
        }
    }

    /// The name of its channel in SI, with the unit, as Dashpot writes it.
    pub fn column(self) -> &'static str {
        match self {
            Self::Time => "time_s",
            Self::Displacement => "displacement_m",
            Self::Force => "force_n",
        }
    }

    /// Its units, that of SI first.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Self::Time => &TIMES,
            Self::Displacement => &LENGTHS,
            Self::Force => &FORCES,
        }
    }

    /// Names of its units, for a message.
    pub fn unit_names(self) -> String {
        let names: Vec<&str> = self.units().iter().map(|unit| unit.name).collect();
        names.join(", ")
    }

    /// The unit of this name or another spelling of it.
    pub fn unit(self, text: &str) -> Option<Unit> {
        let named = |unit: &&Unit| unit.name == text || unit.others.contains(&text);
        self.units().iter().find(named).copied()
    }

    /// The unit that the name of a channel ends with, as `force_kn`.
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
    /// Its name.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// What it measures.
    pub fn quantity(self) -> Quantity {
        self.quantity
    }

    /// `number` of it in SI.
    #[inline]
    pub fn to_si(self, number: f64) -> f64 {
        number * self.factor[0] / self.factor[1]
    }
}
