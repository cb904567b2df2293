//! Elements between two points.

use dashpot_core::DamperParameters;
use nalgebra::Vector3;

use super::error::VehicleError;
use super::friction::{self, FrictionLoad};

/// An element between two points.
///
/// ```
/// use dashpot_rail::vehicle::{Element, End, Law};
/// let ends = [End::track([0.0, 1.0, 0.5]), End::body("body", [0.0, 1.0, 0.5])];
/// let law = Law::SpringDamper { stiffness_n_per_m: [1e6; 3], damping_n_s_per_m: [0.0; 3] };
/// let spring = Element::new("spring", ends, law);
/// assert_eq!(spring.ends[1].on.as_deref(), Some("body"));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Element {
    /// Name.
    pub name: String,
    /// First and second end.
    pub ends: [End; 2],
    /// Relation between the force and the displacement of the second end relative to the first.
    pub law: Law,
}

impl Element {
    /// Returns an element between two ends.
    pub fn new(name: impl Into<String>, ends: [End; 2], law: Law) -> Self {
        Self {
            name: name.into(),
            ends,
            law,
        }
    }
}

/// An end of an element.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct End {
    /// Name of the body or wheelset; `None` on the track.
    pub on: Option<String>,
    /// Longitudinal position, lateral position and height above the top of the rails, m: positive forward, right and
    /// up.
    pub at_m: [f64; 3],
}

impl End {
    /// Returns an end on a body or wheelset.
    pub fn body(name: &str, at_m: [f64; 3]) -> Self {
        Self {
            on: Some(name.to_owned()),
            at_m,
        }
    }

    /// Returns an end on the track.
    pub fn track(at_m: [f64; 3]) -> Self {
        Self { on: None, at_m }
    }

    /// Position in the axes x, y, z (z down), m.
    pub(super) fn position_m(&self) -> [f64; 3] {
        let [x, y, height] = self.at_m;
        [x, y, -height]
    }
}

/// A direction of the track.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    /// Along the track.
    Longitudinal,
    /// Across the track.
    Lateral,
    /// Up and down.
    Vertical,
}

impl Direction {
    /// Index of the axis in x, y, z.
    pub(super) fn axis(self) -> usize {
        match self {
            Self::Longitudinal => 0,
            Self::Lateral => 1,
            Self::Vertical => 2,
        }
    }
}

/// Relation between the force of an element and the displacement of its second end relative to its first.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Law {
    /// Springs and dashpots in parallel along x, y and z, such as a coil spring. Both ends are at the same point.
    SpringDamper {
        /// Stiffness along x, y and z, N/m.
        stiffness_n_per_m: [f64; 3],
        /// Damping along x, y and z, N s/m.
        damping_n_s_per_m: [f64; 3],
    },
    /// Springs and dashpots in parallel along and about x, y and z, such as a rubber bush. Both ends are at the same
    /// point.
    Bush {
        /// Stiffness along x, y and z, N/m.
        stiffness_n_per_m: [f64; 3],
        /// Damping along x, y and z, N s/m.
        damping_n_s_per_m: [f64; 3],
        /// Stiffness about x, y and z, N m/rad.
        stiffness_n_m_per_rad: [f64; 3],
        /// Damping about x, y and z, N m s/rad.
        damping_n_m_s_per_rad: [f64; 3],
    },
    /// A hydraulic damper along one direction. Both ends are at the same point.
    ///
    /// In the linear equations it is a Maxwell element: a dashpot in series with the stiffness of the mounts. The
    /// dashpot has the secant of the damper characteristic in small motion, with the clearance taken up.
    Damper {
        /// Direction of the axis.
        direction: Direction,
        /// The damper. It extends when the second end moves along the axis relative to the first.
        parameters: Box<DamperParameters>,
    },
    /// A two-sided stop: no force within a gap, linear between points, and extrapolated beyond the last point. Both
    /// ends are at the same point. In the linear equations it exerts no force.
    BumpStop {
        /// Direction of the axis.
        direction: Direction,
        /// Magnitudes of displacement, m, and of the resisting force, N. The first point is the gap, with zero force.
        points: Vec<[f64; 2]>,
    },
    /// Dry friction along one direction: a spring in series with a slider, which holds until the force reaches its
    /// limit `friction_n + coefficient load` and then slides at exactly this force (Jenkins element; Iwnicki, Stichel,
    /// Orlova and Hecht, Vehicle System Dynamics 53, 2015, 995-1033). Both ends are at the same point. At standstill it
    /// exerts no force. In the linear equations the slider sticks.
    Friction {
        /// Direction of the axis.
        direction: Direction,
        /// Stiffness of the spring, N/m.
        stiffness_n_per_m: f64,
        /// Constant part of the limit, N.
        friction_n: f64,
        /// Part of the limit that follows the load of a spring.
        load: Option<FrictionLoad>,
    },
    /// A torsion bar that resists the roll of one body relative to the other.
    AntiRollBar {
        /// Roll stiffness, N m/rad.
        stiffness_n_m_per_rad: f64,
    },
    /// A rod along the line between its ends.
    TractionRod {
        /// Stiffness, N/m.
        stiffness_n_per_m: f64,
        /// Damping, N s/m.
        damping_n_s_per_m: f64,
    },
}

impl Law {
    /// Names of all laws, as in a vehicle file.
    pub const NAMES: &[&str] = &[
        "spring_damper",
        "bush",
        "damper",
        "bump_stop",
        "friction",
        "anti_roll_bar",
        "traction_rod",
    ];

    /// Returns the name of the law, one of [`Law::NAMES`].
    ///
    /// ```
    /// use dashpot_rail::vehicle::Law;
    /// let bar = Law::AntiRollBar { stiffness_n_m_per_rad: 2e6 };
    /// assert_eq!(bar.name(), "anti_roll_bar");
    /// ```
    pub fn name(&self) -> &'static str {
        let index = match self {
            Self::SpringDamper { .. } => 0,
            Self::Bush { .. } => 1,
            Self::Damper { .. } => 2,
            Self::BumpStop { .. } => 3,
            Self::Friction { .. } => 4,
            Self::AntiRollBar { .. } => 5,
            Self::TractionRod { .. } => 6,
        };
        Self::NAMES[index]
    }

    /// Vertical stiffness of a spring whose load friction can follow, N/m.
    pub(super) fn vertical_stiffness(&self) -> Option<f64> {
        match self {
            Self::SpringDamper {
                stiffness_n_per_m, ..
            }
            | Self::Bush {
                stiffness_n_per_m, ..
            } => Some(stiffness_n_per_m[2]).filter(|stiffness| *stiffness > 0.0),
            _ => None,
        }
    }

    /// Spring force that resists a displacement of the second end, N; zero for dashpots, dampers and friction, which
    /// are at rest.
    pub(super) fn spring_force(
        &self,
        displacement: Vector3<f64>,
        line: Vector3<f64>,
    ) -> Vector3<f64> {
        match self {
            Self::SpringDamper {
                stiffness_n_per_m, ..
            }
            | Self::Bush {
                stiffness_n_per_m, ..
            } => displacement.component_mul(&Vector3::from(*stiffness_n_per_m)),
            Self::TractionRod {
                stiffness_n_per_m, ..
            } => {
                let along = line.normalize();
                along * (along.dot(&displacement) * stiffness_n_per_m)
            }
            Self::Damper { .. }
            | Self::BumpStop { .. }
            | Self::Friction { .. }
            | Self::AntiRollBar { .. } => Vector3::zeros(),
        }
    }
}

const MAX_STIFFNESS: [f64; 2] = [0.0, 1e12];
const MAX_DAMPING: [f64; 2] = [0.0, 1e10];

/// Maximum number of points of a stop.
pub const MAX_STOP_POINTS: usize = 16;

fn check_three(
    owner: &str,
    name: &'static str,
    values: &[f64; 3],
    allowed: [f64; 2],
) -> Result<(), VehicleError> {
    values
        .iter()
        .try_for_each(|value| VehicleError::check(owner, name, *value, allowed))
}

fn check_stop(points: &[[f64; 2]]) -> Result<(), &'static str> {
    if !(2..=MAX_STOP_POINTS).contains(&points.len()) {
        return Err("2 to 16 points");
    }
    if !points
        .iter()
        .flatten()
        .all(|number| (0.0..=1e8).contains(number))
    {
        return Err("displacements in m and forces in N, each from 0 to 1e8");
    }
    if points[0][1] != 0.0 {
        return Err("a first point with the gap as its displacement and a force of 0");
    }
    let rises = |pair: &[[f64; 2]]| pair[1][0] - pair[0][0] >= 1e-6 && pair[1][1] >= pair[0][1];
    if !points.windows(2).all(rises) {
        return Err("displacements rising by at least 1e-6 m, and forces that do not decrease");
    }
    Ok(())
}

impl Element {
    pub(super) fn check(&self) -> Result<(), VehicleError> {
        let owner = &self.name;
        for end in &self.ends {
            for (name, value) in ["x_m", "y_m", "height_m"].into_iter().zip(end.at_m) {
                VehicleError::check(owner, name, value, [-100.0, 100.0])?;
            }
        }
        if let (Some(first), Some(second)) = (&self.ends[0].on, &self.ends[1].on)
            && first == second
        {
            return Err(VehicleError::SameBody {
                element: owner.clone(),
                on: first.clone(),
            });
        }
        let apart = self.ends[0].at_m != self.ends[1].at_m;
        match &self.law {
            Law::SpringDamper {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                check_three(owner, "stiffness_n_per_m", stiffness_n_per_m, MAX_STIFFNESS)?;
                check_three(owner, "damping_n_s_per_m", damping_n_s_per_m, MAX_DAMPING)?;
            }
            Law::Bush {
                stiffness_n_per_m,
                damping_n_s_per_m,
                stiffness_n_m_per_rad,
                damping_n_m_s_per_rad,
            } => {
                check_three(owner, "stiffness_n_per_m", stiffness_n_per_m, MAX_STIFFNESS)?;
                check_three(owner, "damping_n_s_per_m", damping_n_s_per_m, MAX_DAMPING)?;
                let name = "stiffness_n_m_per_rad";
                check_three(owner, name, stiffness_n_m_per_rad, MAX_STIFFNESS)?;
                let name = "damping_n_m_s_per_rad";
                check_three(owner, name, damping_n_m_s_per_rad, MAX_DAMPING)?;
            }
            Law::Damper { parameters, .. } => {
                parameters.check().map_err(|source| VehicleError::Damper {
                    element: owner.clone(),
                    source: Box::new(source),
                })?;
            }
            Law::BumpStop { points, .. } => {
                check_stop(points).map_err(|reason| VehicleError::Stop {
                    element: owner.clone(),
                    reason,
                })?;
            }
            Law::Friction {
                stiffness_n_per_m,
                friction_n,
                load,
                ..
            } => friction::check(owner, *stiffness_n_per_m, *friction_n, load.as_ref())?,
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => {
                let value = *stiffness_n_m_per_rad;
                VehicleError::check(owner, "stiffness_n_m_per_rad", value, MAX_STIFFNESS)?;
            }
            Law::TractionRod {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                VehicleError::check(
                    owner,
                    "stiffness_n_per_m",
                    *stiffness_n_per_m,
                    MAX_STIFFNESS,
                )?;
                VehicleError::check(owner, "damping_n_s_per_m", *damping_n_s_per_m, MAX_DAMPING)?;
            }
        }
        match (&self.law, apart) {
            (Law::TractionRod { .. }, false) => Err(VehicleError::Ends {
                element: owner.clone(),
                reason: "the ends of a traction rod must be apart, because its axis is the line between them",
            }),
            (Law::TractionRod { .. } | Law::AntiRollBar { .. }, _) | (_, false) => Ok(()),
            (_, true) => Err(VehicleError::Ends {
                element: owner.clone(),
                reason: "both ends of this element must be at the same point",
            }),
        }
    }
}
