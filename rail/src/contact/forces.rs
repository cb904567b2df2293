//! What the contact gives: forces of patches, wheels and the wheelset, and how a wheel stands.

use crate::creep::creepage::{CreepForces, Creepage};

/// How a wheel stands, the later the worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Status {
    /// No patch is loaded.
    #[default]
    Lifted,
    /// Loaded on tread, flange or both.
    Rolling,
    /// The flange is loaded beyond its steepest place: the wheel climbs.
    Climbing,
    /// The flange tip or what lies behind it runs on the rail.
    PastTip,
    /// The place lies outside the tables or the penetration beyond 2 mm: forces of the nearest edge.
    OutsideTables,
    /// A number of the motion is none or beyond 1e9: no forces.
    NotFinite,
}

/// Forces of one patch on the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PatchForces {
    /// Normal load, N; none when apart.
    pub load: f64,
    /// Normal penetration, m; negative when apart.
    pub penetration: f64,
    /// Tangent of the contact angle against the track plane: positive on a cone that widens to the flange.
    pub slope: f64,
    /// Semi-axes in the rolling direction and across, m.
    pub semi_axes: [f64; 2],
    /// Rolling radius, m.
    pub radius: f64,
    /// Place on the wheel from the tread datum, field side positive, m.
    pub s: f64,
    /// Place from the wheelset's centre along x, y (right positive) and z, m.
    pub point: [f64; 3],
    /// Creepages in the axes of [`Creepage`]; the left wheel's are those of its mirror image.
    pub creepage: Creepage,
    /// Creep forces in the same axes.
    pub creep: CreepForces,
    /// Power taken by friction, W.
    pub loss: f64,
}

/// Forces of one rail on its wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelForces {
    /// Tread, then flange.
    pub patches: [PatchForces; 2],
    /// Force in track axes, N.
    pub force: [f64; 3],
    /// Moment about the wheelset's centre in track axes, N m.
    pub moment: [f64; 3],
    /// How the wheel stands.
    pub status: Status,
}

impl PatchForces {
    /// Contact angle against the track plane, rad.
    pub fn angle(&self) -> f64 {
        self.slope.atan()
    }
}

impl WheelForces {
    /// Derailment coefficient `Y/Q` for a wheel on side `sign` (right +1, left -1): positive when the
    /// rail pushes the wheel inward; 0 for a lifted wheel.
    pub fn derailment_coefficient(&self, sign: f64) -> f64 {
        if self.force[2] < 0.0 {
            sign * self.force[1] / self.force[2]
        } else {
            0.0
        }
    }
}

/// Forces of both rails on a wheelset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelsetForces {
    /// The left wheel, then the right.
    pub wheels: [WheelForces; 2],
    /// Force in track axes, N.
    pub force: [f64; 3],
    /// Moment about the centre in track axes, N m.
    pub moment: [f64; 3],
    /// The worse of the two wheels.
    pub status: Status,
}

impl WheelForces {
    /// Turns the forces of the mirror image into those of the wheel itself.
    #[inline]
    pub(super) fn mirror(&mut self) {
        self.force[1] = -self.force[1];
        self.moment[0] = -self.moment[0];
        self.moment[2] = -self.moment[2];
        for patch in &mut self.patches {
            patch.point[1] = -patch.point[1];
        }
    }
}
