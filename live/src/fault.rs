//! Faults that an operator gives a damper.

use dashpot_files::damper::{KeyedParameters, range};
use serde::Serialize;

/// A fault of a damper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FaultKind {
    /// Identifier.
    pub id: &'static str,
    /// In words.
    pub label: &'static str,
    /// Changes of the numbers that the damper has.
    #[serde(skip)]
    changes: &'static [(&'static str, Change)],
}

/// Change of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    To(f64),
    Times(f64),
}

/// All faults.
pub const FAULTS: [FaultKind; 5] = [
    FaultKind {
        id: "torn-off",
        label: "torn off: no force",
        // A clearance that no motion of a vehicle takes up.
        changes: &[("mount.clearance_m", Change::To(0.1))],
    },
    FaultKind {
        id: "worn-seat",
        label: "worn seats: clearance of 6 mm",
        changes: &[("mount.clearance_m", Change::To(6e-3))],
    },
    FaultKind {
        id: "soft-rubber",
        label: "soft rubber: a fifth of the stiffness",
        changes: &[("mount.stiffness_n_per_m", Change::Times(0.2))],
    },
    FaultKind {
        id: "leaking",
        label: "leaking: about half the damping",
        changes: &[
            ("reduced.damping_n_s_per_m", Change::Times(0.5)),
            ("orifice.diameter_m", Change::Times(1.5)),
        ],
    },
    FaultKind {
        id: "blocked",
        label: "blocked orifice: about three times the damping",
        changes: &[
            ("reduced.damping_n_s_per_m", Change::Times(3.0)),
            ("orifice.diameter_m", Change::Times(0.6)),
        ],
    },
];

impl FaultKind {
    /// Returns the fault with an identifier.
    pub(crate) fn find(id: &str) -> Option<&'static Self> {
        FAULTS.iter().find(|fault| fault.id == id)
    }

    /// Numbers of a damper as new that the fault changes, with their new values, within their ranges.
    pub(crate) fn changes(&self, as_new: &KeyedParameters) -> Vec<(&'static str, f64)> {
        let changes = self.changes.iter();
        changes
            .filter_map(|(key, change)| {
                let value = as_new.number(key).ok()?;
                let range = range(key)?;
                let value = match change {
                    Change::To(value) => *value,
                    Change::Times(factor) => factor * value,
                };
                Some((*key, value.clamp(range.min, range.max)))
            })
            .collect()
    }
}
