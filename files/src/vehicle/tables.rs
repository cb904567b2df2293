//! Tables of a vehicle file.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, FrictionLoad, Law, RidePoint, VehicleParameters, Wheelset,
};
use serde::Deserialize;

use super::Replacement;
use super::error::VehicleFileError;
use crate::contact::WheelsTable;
use crate::damper;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VehicleFile {
    name: String,
    #[serde(default)]
    body: Vec<BodyTable>,
    #[serde(default)]
    wheelset: Vec<WheelsetTable>,
    #[serde(default)]
    spring_damper: Vec<SpringDamperTable>,
    #[serde(default)]
    bush: Vec<BushTable>,
    #[serde(default)]
    damper: Vec<DamperTable>,
    #[serde(default)]
    bump_stop: Vec<BumpStopTable>,
    #[serde(default)]
    friction: Vec<FrictionTable>,
    #[serde(default)]
    anti_roll_bar: Vec<AntiRollBarTable>,
    #[serde(default)]
    traction_rod: Vec<TractionRodTable>,
    #[serde(default)]
    ride_point: Vec<RidePointTable>,
    #[serde(default)]
    pub(super) contact: WheelsTable,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BodyTable {
    name: String,
    mass_kg: f64,
    roll_inertia_kg_m2: f64,
    pitch_inertia_kg_m2: f64,
    yaw_inertia_kg_m2: f64,
    x_m: f64,
    height_m: f64,
}

/// Identical wheelsets, named by `name` and a number from 1, one at each `x_m`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WheelsetTable {
    name: String,
    mass_kg: f64,
    roll_inertia_kg_m2: f64,
    spin_inertia_kg_m2: f64,
    yaw_inertia_kg_m2: f64,
    radius_m: f64,
    x_m: Vec<f64>,
}

/// Identical elements, named by `name` and a number from 1, one at each `[x, y, height]` of `at_m`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpringDamperTable {
    name: String,
    between: [String; 2],
    at_m: Vec<[f64; 3]>,
    stiffness_n_per_m: [f64; 3],
    damping_n_s_per_m: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BushTable {
    name: String,
    between: [String; 2],
    at_m: Vec<[f64; 3]>,
    stiffness_n_per_m: [f64; 3],
    damping_n_s_per_m: [f64; 3],
    stiffness_n_m_per_rad: [f64; 3],
    damping_n_m_s_per_rad: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BumpStopTable {
    name: String,
    between: [String; 2],
    at_m: Vec<[f64; 3]>,
    direction: DirectionName,
    /// `[displacement, force]`, m and N.
    points_m_n: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrictionTable {
    name: String,
    between: [String; 2],
    at_m: Vec<[f64; 3]>,
    direction: DirectionName,
    stiffness_n_per_m: f64,
    friction_n: Option<f64>,
    friction_coefficient: Option<f64>,
    /// Name of the springs: the first element follows the load of the first one, and so on.
    load_of: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DamperTable {
    name: String,
    between: [String; 2],
    at_m: Vec<[f64; 3]>,
    direction: DirectionName,
    /// Preset or file.
    damper: String,
    #[serde(default)]
    set: Vec<String>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum DirectionName {
    Longitudinal,
    Lateral,
    Vertical,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AntiRollBarTable {
    name: String,
    between: [String; 2],
    at_m: [f64; 3],
    stiffness_n_m_per_rad: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TractionRodTable {
    name: String,
    between: [String; 2],
    from_m: [f64; 3],
    to_m: [f64; 3],
    stiffness_n_per_m: f64,
    damping_n_s_per_m: f64,
}

/// Ride measurement point: a position `[x, y, height]` on a body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RidePointTable {
    name: String,
    body: String,
    at_m: [f64; 3],
}

impl From<DirectionName> for Direction {
    fn from(name: DirectionName) -> Self {
        match name {
            DirectionName::Longitudinal => Self::Longitudinal,
            DirectionName::Lateral => Self::Lateral,
            DirectionName::Vertical => Self::Vertical,
        }
    }
}

/// Name that attaches an element's end to the track.
const TRACK: &str = "track";

fn end(on: &str, at_m: [f64; 3]) -> End {
    if on == TRACK {
        End::track(at_m)
    } else {
        End::body(on, at_m)
    }
}

/// Equal elements at several positions.
fn elements(name: &str, between: &[String; 2], at_m: &[[f64; 3]], law: &Law) -> Vec<Element> {
    numbered_elements(name, between, at_m, |_| law.clone())
}

/// Elements at several positions, with a law for each number from 1 on.
fn numbered_elements(
    name: &str,
    [from, to]: &[String; 2],
    at_m: &[[f64; 3]],
    law: impl Fn(usize) -> Law,
) -> Vec<Element> {
    let numbered = (1..).zip(at_m);
    numbered
        .map(|(number, at)| {
            let ends = [end(from, *at), end(to, *at)];
            Element::new(format!("{name} {number}"), ends, law(number))
        })
        .collect()
}

impl FrictionTable {
    /// Its elements, which differ in the spring that they follow.
    fn elements(&self) -> Result<Vec<Element>, &'static str> {
        let of_load = match (self.friction_coefficient, &self.load_of) {
            (Some(coefficient), Some(springs)) => Some((coefficient, springs)),
            (None, None) if self.friction_n.is_none() => {
                return Err(
                    "no friction, allowed: friction_n, or friction_coefficient and load_of",
                );
            }
            (None, None) => None,
            _ => return Err("friction_coefficient and load_of, allowed: both or neither"),
        };
        let law = |number| Law::Friction {
            direction: self.direction.into(),
            stiffness_n_per_m: self.stiffness_n_per_m,
            friction_n: self.friction_n.unwrap_or(0.0),
            load: of_load.map(|(coefficient, springs)| {
                FrictionLoad::new(coefficient, format!("{springs} {number}"))
            }),
        };
        Ok(numbered_elements(
            &self.name,
            &self.between,
            &self.at_m,
            law,
        ))
    }
}

impl VehicleFile {
    /// Converts the tables to a vehicle; `locate` returns file and line of a part for error messages.
    pub fn vehicle(
        self,
        replaced: &[Option<&Replacement>],
        locate: impl Fn(&str) -> String,
    ) -> Result<VehicleParameters, VehicleFileError> {
        let bodies = self.body.into_iter().map(|table| {
            let inertia_kg_m2 = [
                table.roll_inertia_kg_m2,
                table.pitch_inertia_kg_m2,
                table.yaw_inertia_kg_m2,
            ];
            Body::new(table.name, table.mass_kg, inertia_kg_m2, table.height_m).with_x_m(table.x_m)
        });
        let mut wheelsets = Vec::new();
        for table in self.wheelset {
            for (number, x_m) in table.x_m.into_iter().enumerate() {
                let name = format!("{} {}", table.name, number + 1);
                let inertia_kg_m2 = [
                    table.roll_inertia_kg_m2,
                    table.spin_inertia_kg_m2,
                    table.yaw_inertia_kg_m2,
                ];
                wheelsets.push(
                    Wheelset::new(name, table.mass_kg, inertia_kg_m2, table.radius_m).with_x_m(x_m),
                );
            }
        }
        let mut all = Vec::new();
        for table in &self.spring_damper {
            let law = Law::SpringDamper {
                stiffness_n_per_m: table.stiffness_n_per_m,
                damping_n_s_per_m: table.damping_n_s_per_m,
            };
            all.extend(elements(&table.name, &table.between, &table.at_m, &law));
        }
        for table in &self.bush {
            let law = Law::Bush {
                stiffness_n_per_m: table.stiffness_n_per_m,
                damping_n_s_per_m: table.damping_n_s_per_m,
                stiffness_n_m_per_rad: table.stiffness_n_m_per_rad,
                damping_n_m_s_per_rad: table.damping_n_m_s_per_rad,
            };
            all.extend(elements(&table.name, &table.between, &table.at_m, &law));
        }
        for table in &self.bump_stop {
            let law = Law::BumpStop {
                direction: table.direction.into(),
                points: table.points_m_n.clone(),
            };
            all.extend(elements(&table.name, &table.between, &table.at_m, &law));
        }
        for table in &self.friction {
            let elements = table.elements();
            all.extend(elements.map_err(|reason| VehicleFileError::Friction {
                name: locate(&table.name),
                element: table.name.clone(),
                reason,
            })?);
        }
        for (number, table) in self.damper.iter().enumerate() {
            let replacement = replaced.get(number).copied().flatten();
            // A later override may have replaced the damper again.
            let replacement = replacement.filter(|replacement| replacement.damper == table.damper);
            let parameters = match replacement.and_then(|by| by.parameters.as_deref()) {
                Some(parameters) => damper::change(&table.damper, parameters, &table.set),
                None => damper::load(&table.damper, &table.set),
            };
            let parameters = parameters.map_err(|source| VehicleFileError::Damper {
                name: locate(&table.name),
                element: table.name.clone(),
                source: Box::new(source),
            })?;
            let law = Law::Damper {
                direction: table.direction.into(),
                parameters: Box::new(DamperParameters::clone(&parameters)),
            };
            all.extend(elements(&table.name, &table.between, &table.at_m, &law));
        }
        for table in self.anti_roll_bar {
            let [from, to] = &table.between;
            let ends = [end(from, table.at_m), end(to, table.at_m)];
            let law = Law::AntiRollBar {
                stiffness_n_m_per_rad: table.stiffness_n_m_per_rad,
            };
            all.push(Element::new(table.name, ends, law));
        }
        for table in self.traction_rod {
            let [from, to] = &table.between;
            let ends = [end(from, table.from_m), end(to, table.to_m)];
            let law = Law::TractionRod {
                stiffness_n_per_m: table.stiffness_n_per_m,
                damping_n_s_per_m: table.damping_n_s_per_m,
            };
            all.push(Element::new(table.name, ends, law));
        }
        let ride_points = self.ride_point.into_iter();
        let ride_points =
            ride_points.map(|table| RidePoint::new(table.name, table.body, table.at_m));
        Ok(VehicleParameters::new(self.name)
            .with_bodies(bodies)
            .with_wheelsets(wheelsets)
            .with_elements(all)
            .with_ride_points(ride_points))
    }
}
