//! Table of a single track defect.

use dashpot_rail::track::{Defect, Rails};
use serde::Deserialize;

use super::keys::Keys;

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    CosineDip,
    AlignmentBump,
    AlignmentKink,
    Twist,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum RailsName {
    Left,
    Right,
    Both,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DefectTable {
    kind: Kind,
    rails: Option<RailsName>,
    start_m: Option<f64>,
    length_m: Option<f64>,
    depth_m: Option<f64>,
    offset_m: Option<f64>,
    rounding_m: Option<f64>,
    base_m: Option<f64>,
    plateau_m: Option<f64>,
    cross_level_m: Option<f64>,
}

impl DefectTable {
    fn keys(&self) -> Keys {
        Keys {
            owner: match self.kind {
                Kind::CosineDip => "a cosine dip",
                Kind::AlignmentBump => "an alignment bump",
                Kind::AlignmentKink => "an alignment kink",
                Kind::Twist => "a twist",
            },
            given: vec![
                ("start_m", self.start_m),
                ("length_m", self.length_m),
                ("depth_m", self.depth_m),
                ("offset_m", self.offset_m),
                ("rounding_m", self.rounding_m),
                ("base_m", self.base_m),
                ("plateau_m", self.plateau_m),
                ("cross_level_m", self.cross_level_m),
            ],
        }
    }

    /// Returns the rails, which every kind except a twist requires.
    fn rails(&self, owner: &str) -> Result<Rails, String> {
        match self.rails {
            Some(RailsName::Left) => Ok(Rails::Left),
            Some(RailsName::Right) => Ok(Rails::Right),
            Some(RailsName::Both) => Ok(Rails::Both),
            None => Err(format!("{owner} needs `rails`")),
        }
    }

    /// Converts the table to a defect.
    ///
    /// # Errors
    /// Returns an error message for a missing key, or for a key that does not apply to this kind.
    pub fn defect(&self) -> Result<Defect, String> {
        let mut keys = self.keys();
        let owner = keys.owner;
        let start_m = keys.take("start_m")?;
        let defect = match self.kind {
            Kind::CosineDip => Defect::CosineDip {
                rails: self.rails(owner)?,
                start_m,
                length_m: keys.take("length_m")?,
                depth_m: keys.take("depth_m")?,
            },
            Kind::AlignmentBump => Defect::AlignmentBump {
                rails: self.rails(owner)?,
                start_m,
                length_m: keys.take("length_m")?,
                offset_m: keys.take("offset_m")?,
            },
            Kind::AlignmentKink => Defect::AlignmentKink {
                rails: self.rails(owner)?,
                start_m,
                length_m: keys.take("length_m")?,
                offset_m: keys.take("offset_m")?,
                rounding_m: keys.take("rounding_m")?,
            },
            Kind::Twist if self.rails.is_some() => {
                return Err("a twist has no `rails`: half of it is on each rail".into());
            }
            Kind::Twist => Defect::Twist {
                start_m,
                base_m: keys.take("base_m")?,
                plateau_m: keys.take("plateau_m")?,
                cross_level_m: keys.take("cross_level_m")?,
                rounding_m: keys.take("rounding_m")?,
            },
        };
        keys.end()?;
        Ok(defect)
    }
}
