//! Elements between two points.

use nalgebra::Vector3;

use super::error::{VehicleError, finite};

/// An element between two points.
#[derive(Debug, Clone, PartialEq)]
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
pub enum Direction {
    /// Along the track.
    Longitudinal,
    /// Across.
    Lateral,
    /// Up and down.
    Vertical,
}

/// How the force of an element follows from the displacement of its second end against its first.
#[derive(Debug, Clone, PartialEq)]
pub enum Law {
    /// Springs and dashpots side by side along x, y and z: a coil spring, a rubber bush. The ends are at one place.
    SpringDamper {
        /// Stiffness along x, y and z, N/m.
        stiffness_n_per_m: [f64; 3],
        /// Damping along x, y and z, N s/m.
        damping_n_s_per_m: [f64; 3],
    },
    /// A dashpot in series with a spring in one direction (Maxwell): a hydraulic damper in small motion, whose clearance is
    /// taken up. The ends are at one place.
    Damper {
        /// Direction of the axis.
        direction: Direction,
        /// Force over velocity at small velocity, N s/m.
        damping_n_s_per_m: f64,
        /// Stiffness in series, N/m.
        stiffness_n_per_m: f64,
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
            } => displacement.component_mul(&Vector3::from(*stiffness_n_per_m)),
            Self::TractionRod {
                stiffness_n_per_m, ..
            } => {
                let along = line.normalize();
                along * (along.dot(&displacement) * stiffness_n_per_m)
            }
            Self::Damper { .. } | Self::AntiRollBar { .. } => Vector3::zeros(),
        }
    }
}

const MAX_STIFFNESS: [f64; 2] = [0.0, 1e12];
const MAX_DAMPING: [f64; 2] = [0.0, 1e10];
/// Least stiffness and damping of a damper: it is an element of both.
const SERIES: [f64; 2] = [1.0, 1e12];

impl Element {
    pub(super) fn check(&self) -> Result<(), VehicleError> {
        let owner = &self.name;
        for end in &self.ends {
            for (name, value) in ["x_m", "y_m", "height_m"].into_iter().zip(end.at_m) {
                finite(owner, name, value, [-100.0, 100.0])?;
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
        let ends = |reason| VehicleError::Ends {
            element: owner.clone(),
            reason,
        };
        match &self.law {
            Law::SpringDamper {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                for (stiffness, damping) in stiffness_n_per_m.iter().zip(damping_n_s_per_m) {
                    finite(owner, "stiffness_n_per_m", *stiffness, MAX_STIFFNESS)?;
                    finite(owner, "damping_n_s_per_m", *damping, MAX_DAMPING)?;
                }
                if apart {
                    return Err(ends("the ends of a spring-damper are at one place"));
                }
            }
            Law::Damper {
                damping_n_s_per_m,
                stiffness_n_per_m,
                ..
            } => {
                finite(owner, "damping_n_s_per_m", *damping_n_s_per_m, SERIES)?;
                finite(owner, "stiffness_n_per_m", *stiffness_n_per_m, SERIES)?;
                if apart {
                    return Err(ends("the ends of a damper are at one place"));
                }
            }
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => {
                let value = *stiffness_n_m_per_rad;
                finite(owner, "stiffness_n_m_per_rad", value, MAX_STIFFNESS)?;
            }
            Law::TractionRod {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                finite(
                    owner,
                    "stiffness_n_per_m",
                    *stiffness_n_per_m,
                    MAX_STIFFNESS,
                )?;
                finite(owner, "damping_n_s_per_m", *damping_n_s_per_m, MAX_DAMPING)?;
                if !apart {
                    return Err(ends(
                        "the ends of a traction rod are apart: its line is its direction",
                    ));
                }
            }
        }
        Ok(())
    }
}
