//! A centred wheelset on rails that carry its load.

use crate::contact::{Motion, PatchSource, RailDisplacement, WheelsetContact};
use crate::creep::CreepLaw;

/// Equilibrium of a centred wheelset under its load, and the radius on which it rolls freely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carried {
    /// Vertical displacement as in [`Motion`], m.
    pub vertical_m: f64,
    /// Rolling radius of the patch with the largest load, m.
    pub rolling_radius_m: f64,
    /// Energy of the patches, J: `2/5 N penetration` each (Hertz).
    pub contact_j: f64,
    /// Forces of the left and right rail on their wheels, N.
    pub wheel_forces_n: [[f64; 3]; 2],
}

/// Speed at which the contact is evaluated, m/s. Creep forces do not depend on it.
const SPEED_M_PER_S: f64 = 20.0;

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
        let radius = |motion: &Motion| {
            let patches = contact.forces(motion, &rails).wheels[1].patches;
            let main = patches.iter().max_by(|a, b| a.load_n.total_cmp(&b.load_n));
            main.map(|patch| patch.rolling_radius_m)
        };
        // Twice, because longitudinal creep tilts the force slightly until the wheelset rolls freely.
        for _ in 0..2 {
            motion.vertical_m = carry(load, |vertical_m| {
                motion.vertical_m = vertical_m;
                -contact.forces(&motion, &rails).force_n[2]
            })?;
            motion.rotation_rad_per_s = SPEED_M_PER_S / radius(&motion)?;
        }
        let forces = contact.forces(&motion, &rails);
        let patches = forces
            .wheels
            .iter()
            .flat_map(|wheel| wheel.loaded_patches());
        let contact_j = patches
            .map(|patch| 0.4 * patch.load_n * patch.penetration_m)
            .sum();
        Some(Self {
            contact_j,
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
