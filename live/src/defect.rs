//! Defects that an operator puts on the track.

use dashpot_rail::track::{Defect, Rails};
use serde::Serialize;

/// Distance from the leading wheelset to a new defect, m.
pub(crate) const AHEAD_M: f64 = 30.0;

/// A kind of defect with its sizes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DefectKind {
    /// Identifier.
    pub kind: &'static str,
    /// In words.
    pub label: &'static str,
    /// Unit of the size.
    pub size_unit: &'static str,
    /// Smallest size.
    pub min: f64,
    /// Largest size.
    pub max: f64,
    /// Usual size.
    pub value: f64,
}

/// All kinds of defects.
pub const DEFECTS: [DefectKind; 4] = [
    DefectKind {
        kind: "dip",
        label: "dip of the left rail, 6 m long",
        size_unit: "mm",
        min: 1.0,
        max: 20.0,
        value: 8.0,
    },
    DefectKind {
        kind: "dip-both",
        label: "dip of both rails, 6 m long",
        size_unit: "mm",
        min: 1.0,
        max: 30.0,
        value: 12.0,
    },
    DefectKind {
        kind: "alignment",
        label: "alignment to the right, 10 m long",
        size_unit: "mm",
        min: 1.0,
        max: 20.0,
        value: 8.0,
    },
    DefectKind {
        kind: "twist",
        label: "twist over 4 m, plateau of 6 m",
        size_unit: "mm",
        min: 1.0,
        max: 40.0,
        value: 15.0,
    },
];

/// Returns the defect of a kind and size that starts at a distance, or `None` for an unknown kind or a size out of
/// range.
pub(crate) fn defect(kind: &str, size: f64, start_m: f64) -> Option<Defect> {
    let known = DEFECTS.iter().find(|known| known.kind == kind)?;
    if !(known.min..=known.max).contains(&size) {
        return None;
    }
    let size_m = 1e-3 * size;
    let dip = |rails| Defect::CosineDip {
        rails,
        start_m,
        length_m: 6.0,
        depth_m: size_m,
    };
    Some(match kind {
        "dip" => dip(Rails::Left),
        "dip-both" => dip(Rails::Both),
        "alignment" => Defect::AlignmentBump {
            rails: Rails::Both,
            start_m,
            length_m: 10.0,
            offset_m: size_m,
        },
        _ => Defect::Twist {
            start_m,
            base_m: 4.0,
            plateau_m: 6.0,
            cross_level_m: size_m,
            rounding_m: 1.0,
        },
    })
}
