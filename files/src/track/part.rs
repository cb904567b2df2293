//! Table of a part of the layout.

use dashpot_rail::track::Part;
use serde::Deserialize;

use super::keys::Keys;

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Straight,
    Transition,
    Circular,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartTable {
    kind: Kind,
    length_m: Option<f64>,
    radius_m: Option<f64>,
    cant_m: Option<f64>,
}

impl PartTable {
    /// Converts the table to a part.
    ///
    /// # Errors
    /// Returns an error message for a missing key, or for a key that does not apply to this kind.
    pub fn part(&self) -> Result<Part, String> {
        let owner = match self.kind {
            Kind::Straight => "a straight part",
            Kind::Transition => "a transition",
            Kind::Circular => "a circular part",
        };
        let given = vec![
            ("length_m", self.length_m),
            ("radius_m", self.radius_m),
            ("cant_m", self.cant_m),
        ];
        let mut keys = Keys { owner, given };
        let length_m = keys.take("length_m")?;
        let part = match self.kind {
            Kind::Straight => Part::Straight { length_m },
            Kind::Transition => Part::Transition { length_m },
            Kind::Circular => Part::Circular {
                radius_m: keys.take("radius_m")?,
                length_m,
                cant_m: keys.take("cant_m")?,
            },
        };
        keys.end()?;
        Ok(part)
    }
}
