//! Creepages, creep forces, and what every creep law must keep.
//!
//! Axes of a contact: 1 in the rolling direction, 2 along the tangent to the field side, 3 into the rail.
//! Forces act on the wheel; creepages are those of the wheel's surface over the rail's.

use super::kalker::Coefficients;

/// Sliding over speed at a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Creepage {
    /// Longitudinal creepage, dimensionless.
    pub longitudinal: f64,
    /// Lateral creepage, dimensionless.
    pub lateral: f64,
    /// Spin, turning about axis 3 over speed, 1/m.
    pub spin: f64,
}

/// Greatest creepage taken as it is; far beyond full sliding.
const HUGE: f64 = 1e6;

impl Creepage {
    /// The same, numbers beyond 1e6 cut there and those that are none set to zero.
    pub fn finite(self) -> Self {
        let hold = |x: f64| {
            if x.is_nan() {
                0.0
            } else {
                x.clamp(-HUGE, HUGE)
            }
        };
        Self {
            longitudinal: hold(self.longitudinal),
            lateral: hold(self.lateral),
            spin: hold(self.spin),
        }
    }

    /// Magnitude without spin.
    pub fn sliding(&self) -> f64 {
        (self.longitudinal * self.longitudinal + self.lateral * self.lateral).sqrt()
    }
}

/// One loaded contact as the creep laws need it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedContact {
    /// Normal load, N.
    pub load: f64,
    /// Semi-axis in the rolling direction, m.
    pub a: f64,
    /// Semi-axis across, m.
    pub b: f64,
    /// Shear modulus, Pa.
    pub shear: f64,
    /// Kalker's coefficients of the ellipse.
    pub kalker: Coefficients,
    /// Friction coefficient at this sliding speed.
    pub friction: f64,
}

/// Creep forces on the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepForces {
    /// Force in the rolling direction, N.
    pub longitudinal: f64,
    /// Force along the tangent, to the field side, N.
    pub lateral: f64,
    /// Moment about axis 3, N m.
    pub moment: f64,
}

impl CreepForces {
    /// Magnitude of the force, N.
    pub fn magnitude(&self) -> f64 {
        (self.longitudinal * self.longitudinal + self.lateral * self.lateral).sqrt()
    }

    /// Power taken from the motion over the speed, N: `-(Fx xi + Fy eta + M phi)`, never negative.
    pub fn loss(&self, creepage: &Creepage) -> f64 {
        -(self.longitudinal * creepage.longitudinal
            + self.lateral * creepage.lateral
            + self.moment * creepage.spin)
    }
}

/// A law of creep forces.
pub trait CreepLaw {
    /// Forces as the law's source gives them; the load, the semi-axes and the friction are positive.
    fn raw(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces;

    /// Forces within friction that never create energy; none without load.
    fn forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let limit = contact.friction * contact.load;
        let area = contact.a * contact.b;
        if !(limit > 0.0 && limit.is_finite() && area > 0.0 && area.is_finite()) {
            return CreepForces::default();
        }
        let creepage = creepage.finite();
        keep_passive(contact, &creepage, self.raw(contact, &creepage))
    }
}

/// Kalker's linear forces: `Fx = -G ab C11 xi`, `Fy = -G ab C22 eta - G (ab)^1.5 C23 phi`,
/// `M = G (ab)^1.5 C23 eta - G (ab)^2 C33 phi`.
#[inline]
pub fn linear(contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
    let area = contact.a * contact.b;
    let stiffness = contact.shear * area;
    let arm = area.sqrt();
    let k = &contact.kalker;
    CreepForces {
        longitudinal: -stiffness * k.c11 * creepage.longitudinal,
        lateral: -stiffness * (k.c22 * creepage.lateral + arm * k.c23 * creepage.spin),
        moment: stiffness * arm * (k.c23 * creepage.lateral - arm * k.c33 * creepage.spin),
    }
}

/// Holds the force within friction and the moment within that of full spin under Hertz pressure
/// (`3 pi / 16 mu N r` for a circle, here with the greater semi-axis), then takes what would create
/// energy first from the moment, then from the force along the sliding.
#[inline]
pub fn keep_passive(
    contact: &LoadedContact,
    creepage: &Creepage,
    mut forces: CreepForces,
) -> CreepForces {
    let limit = contact.friction * contact.load;
    let square = forces.longitudinal * forces.longitudinal + forces.lateral * forces.lateral;
    if square > limit * limit {
        let share = limit / square.sqrt();
        forces.longitudinal *= share;
        forces.lateral *= share;
    }
    let turn = 3.0 * std::f64::consts::PI / 16.0 * limit * contact.a.max(contact.b);
    forces.moment = forces.moment.max(-turn).min(turn);
    let mut gain = -forces.loss(creepage);
    if gain > 0.0 && creepage.spin != 0.0 {
        forces.moment = (forces.moment - gain / creepage.spin).max(-turn).min(turn);
        gain = -forces.loss(creepage);
    }
    if gain > 0.0 {
        let square = creepage.longitudinal.powi(2) + creepage.lateral.powi(2);
        if square > 0.0 {
            forces.longitudinal -= gain * creepage.longitudinal / square;
            forces.lateral -= gain * creepage.lateral / square;
        }
    }
    forces
}
