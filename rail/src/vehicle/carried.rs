//! A centred wheelset on rails that carry its load.

use crate::contact::{Motion, PatchSource, RailDisplacement, WheelForces, WheelsetContact};
use crate::creep::CreepLaw;

/// Equilibrium of a centred wheelset under its load, and the radius on which it rolls freely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carried {
    /// Vertical displacement as in [`Motion`], m.
    pub vertical_m: f64,
    /// Radius on which the wheelset rolls without a moment about its axle, m.
    pub rolling_radius_m: f64,
    /// Elastic energy of the contact of both wheels, J.
    pub contact_j: f64,
    /// Forces of the left and right rail on their wheels, N.
    pub wheel_forces_n: [[f64; 3]; 2],
    /// Stiffness of the contact of the stiffer wheel along the normal, N/m.
    pub wheel_stiffness_n_per_m: f64,
    /// Product of the semi-axes of the contact, summed over the patches of the wheel with the larger sum, m^2.
    pub wheel_axes_m2: f64,
}

/// Speed at which the contact is evaluated, m/s. Creep forces do not depend on it.
const SPEED_M_PER_S: f64 = 20.0;
/// Rotations of the largest and of the smallest wheel at this speed, rad/s.
const ROTATIONS_RAD_PER_S: (f64, f64) = (SPEED_M_PER_S / 1.1, SPEED_M_PER_S / 0.09);

impl Carried {
    /// Finds the height at which the rails carry `load`, by bisection; `None` if there is none within 2 mm.
    pub fn new<L: CreepLaw, S: PatchSource>(
        contact: &WheelsetContact<L, S>,
        load: f64,
    ) -> Option<Self> {
        if load <= 0.0 {
            return None;
        }
        let rails = [RailDisplacement::default(); 2];
        let mut motion = Motion {
            speed_m_per_s: SPEED_M_PER_S,
            rotation_rad_per_s: SPEED_M_PER_S / 0.5,
            ..Motion::default()
        };
        // Twice, because longitudinal creep tilts the force slightly until the wheelset rolls freely.
        for _ in 0..2 {
            motion.vertical_m = carry(load, |vertical_m| {
                motion.vertical_m = vertical_m;
                -contact.forces(&motion, &rails).force_n[2]
            })?;
            motion.rotation_rad_per_s = free_rotation(|rotation_rad_per_s| {
                motion.rotation_rad_per_s = rotation_rad_per_s;
                contact.forces(&motion, &rails).moment_n_m[1]
            });
        }
        let forces = contact.forces(&motion, &rails);
        let contact_j = contact.elastic_energy_j(&motion, &rails).iter().sum();
        let stiffness = |wheel: &WheelForces| -> f64 {
            let patches = wheel.loaded_patches();
            patches.map(|patch| patch.stiffness_n_per_m).sum()
        };
        let axes = |wheel: &WheelForces| -> f64 {
            let patches = wheel.loaded_patches();
            patches
                .map(|patch| patch.semi_axes_m[0] * patch.semi_axes_m[1])
                .sum()
        };
        let larger =
            |of: &dyn Fn(&WheelForces) -> f64| of(&forces.wheels[0]).max(of(&forces.wheels[1]));
        Some(Self {
            contact_j,
            wheel_stiffness_n_per_m: larger(&stiffness),
            wheel_axes_m2: larger(&axes),
            wheel_forces_n: [forces.wheels[0].force_n, forces.wheels[1].force_n],
            vertical_m: motion.vertical_m,
            rolling_radius_m: SPEED_M_PER_S / motion.rotation_rad_per_s,
        })
    }

    /// Motion of free rolling at a speed.
    pub fn motion(&self, speed_m_per_s: f64) -> Motion {
        Motion {
            speed_m_per_s,
            vertical_m: self.vertical_m,
            rotation_rad_per_s: speed_m_per_s / self.rolling_radius_m,
            ..Motion::default()
        }
    }
}

/// Rotation, rad/s, at which the rails neither drive nor brake the wheelset, by bisection: the faster the wheels turn,
/// the more the moment about the axle brakes them, until they slide.
fn free_rotation(mut moment_n_m: impl FnMut(f64) -> f64) -> f64 {
    let (mut slow, mut fast) = ROTATIONS_RAD_PER_S;
    for _ in 0..60 {
        let middle = 0.5 * (slow + fast);
        if moment_n_m(middle) > 0.0 {
            fast = middle;
        } else {
            slow = middle;
        }
    }
    0.5 * (slow + fast)
}

/// Lowers the wheelset until the rails carry more than `load`, then bisects.
fn carry(load: f64, mut carried: impl FnMut(f64) -> f64) -> Option<f64> {
    let (mut above, mut below) = (-2e-3, -2e-3);
    while carried(below) <= load {
        if below > 2e-3 {
            return None;
        }
        (above, below) = (below, below + 0.2e-3);
    }
    for _ in 0..60 {
        let middle = 0.5 * (above + below);
        if carried(middle) > load {
            below = middle;
        } else {
            above = middle;
        }
    }
    Some(0.5 * (above + below))
}
