//! Elements between two points.

use dashpot_core::DamperParameters;
use nalgebra::Vector3;

use super::error::VehicleError;

/// An element between two points.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Element {
    /// Name.
    pub name: String,
    /// Where it is attached.
    pub ends: [End; 2],
    /// How its force follows from the displacement of the second end against the first.
    pub law: Law,
}

/// An end of an element.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct End {
    /// Name of the body or wheelset; of none on the track.
    pub on: Option<String>,
    /// Longitudinal and lateral position and height above the rails' top, m: forward, right and up positive.
    pub at_m: [f64; 3],
}

impl End {
    /// On a body or wheelset.
    pub fn body(name: &str, at_m: [f64; 3]) -> Self {
        Self {
            on: Some(name.to_owned()),
            at_m,
        }
    }

    /// On the track.
    pub fn track(at_m: [f64; 3]) -> Self {
        Self { on: None, at_m }
    }

    /// In axes x, y, z.
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
    /// Across.
    Lateral,
    /// Up and down.
    Vertical,
}

impl Direction {
    /// Number of its axis: x, y, z.
    pub(super) fn axis(self) -> usize {
        match self {
            Self::Longitudinal => 0,
            Self::Lateral => 1,
            Self::Vertical => 2,
        }
    }
}

/// How the force of an element follows from the displacement of its second end against its first.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Law {
    /// Springs and dashpots side by side along x, y and z: a coil spring, a rubber bush. The ends are at one place.
    SpringDamper {
        /// Stiffness along x, y and z, N/m.
        stiffness_n_per_m: [f64; 3],
        /// Damping along x, y and z, N s/m.
        damping_n_s_per_m: [f64; 3],
    },
    /// Springs and dashpots side by side along and about x, y and z: a rubber bush. The ends are at one place.
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
    /// A hydraulic damper along one direction. Linear equations have it in small motion, its clearance taken up: the secant of
    /// its characteristic in series with the stiffness of its mounts (Maxwell). The ends are at one place.
    Damper {
        /// Direction of the axis.
        direction: Direction,
        /// The damper; extended where the second end moves along the axis against the first.
        parameters: Box<DamperParameters>,
    },
    /// A stop on both sides: no force within a gap, then linear between points and on beyond the last. The ends are at one place.
    /// Linear equations have it open.
    BumpStop {
        /// Direction of the axis.
        direction: Direction,
        /// Magnitudes of displacement, m, and force against it, N: the first is the gap with no force.
        points: Vec<[f64; 2]>,
    },
    /// A torsion bar that resists the roll of one body against the other.
    AntiRollBar {
        /// Moment over angle, N m/rad.
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
    /// Force of the springs against a displacement of the second end, N; dashpots have none at rest, nor has a damper.
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
            Self::Damper { .. } | Self::BumpStop { .. } | Self::AntiRollBar { .. } => {
                Vector3::zeros()
            }
        }
    }
}

const MAX_STIFFNESS: [f64; 2] = [0.0, 1e12];
const MAX_DAMPING: [f64; 2] = [0.0, 1e10];

/// Greatest number of points of a stop.
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
        return Err("displacements and forces of 0 to 1e8 m and N");
    }
    if points[0][1] != 0.0 {
        return Err("no force at the first displacement, which is the gap");
    }
    let rises = |pair: &[[f64; 2]]| pair[1][0] - pair[0][0] >= 1e-6 && pair[1][1] >= pair[0][1];
    if !points.windows(2).all(rises) {
        return Err("displacements that rise by 1e-6 m at least, and forces that do not fall");
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
                reason: "the ends of a traction rod are apart: its line is its direction",
            }),
            (Law::TractionRod { .. } | Law::AntiRollBar { .. }, _) | (_, false) => Ok(()),
            (_, true) => Err(VehicleError::Ends {
                element: owner.clone(),
                reason: "the ends of this element are at one place",
            }),
        }
    }
}
