//! Contact forces on a wheelset: tables, Hertz and a creep law for each of its four patches.

use super::forces::{Status, WheelForces, WheelsetForces};
use super::motion::{Frame, Motion, Rail};
use super::pair::Place;
use super::table::{Entry, Tables};
use crate::creep::creepage::{CreepLaw, Creepage, LoadedContact};
use crate::creep::friction::Friction;

/// Normal penetration beyond which steel does not stay elastic, m.
const DEEPEST: f64 = 2e-3;

/// The contact of a wheelset: constant, shared by every wheelset of the same pair.
#[derive(Debug, Clone)]
pub struct WheelsetContact<L> {
    tables: Tables,
    law: L,
    friction: Friction,
    /// Shear modulus of the steel, Pa.
    shear: f64,
}

impl<L: CreepLaw> WheelsetContact<L> {
    /// Contact by `tables`, `law` and `friction`.
    pub fn new(tables: Tables, law: L, friction: Friction) -> Self {
        let shear = tables.steel().shear();
        Self {
            tables,
            law,
            friction,
            shear,
        }
    }

    /// The tables in use.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// Forces on a wheelset in `motion` over the left and the right rail. Does not allocate.
    #[inline]
    pub fn forces(&self, motion: &Motion, rails: &[Rail; 2]) -> WheelsetForces {
        let mut forces = WheelsetForces::default();
        let [left, right] = &mut forces.wheels;
        let finite = motion.is_finite();
        let frame = Frame::new(motion);
        self.wheel(finite, &frame.mirrored(), &rails[0].mirrored(), left);
        left.mirror();
        self.wheel(finite, &frame, &rails[1], right);
        for k in 0..3 {
            forces.force[k] = left.force[k] + right.force[k];
            forces.moment[k] = left.moment[k] + right.moment[k];
        }
        forces.status = left.status.max(right.status);
        forces
    }

    /// Forces on a wheel, told for the right side.
    fn wheel(&self, finite: bool, frame: &Frame, rail: &Rail, forces: &mut WheelForces) {
        if !(finite && rail.is_finite()) {
            forces.status = Status::NotFinite;
            return;
        }
        let installation = &self.tables.pair().installation;
        let [shift, drop] = frame.shift(installation.datum(), installation.wheel_radius);
        let place = Place {
            lateral: shift - rail.lateral,
            roll: frame.roll,
            yaw: frame.yaw,
        };
        let below = drop - rail.vertical;
        let (entries, inside) = self.tables.at(&place);
        if !inside {
            forces.status = Status::OutsideTables;
        }
        for (which, entry) in entries.iter().enumerate() {
            self.patch(frame, rail, entry, below, which, forces);
        }
    }

    /// Adds one patch to the wheel's `forces`.
    #[inline]
    fn patch(
        &self,
        frame: &Frame,
        rail: &Rail,
        entry: &Entry,
        below: f64,
        which: usize,
        forces: &mut WheelForces,
    ) {
        let pair = self.tables.pair();
        let cos = 1.0 / (1.0 + entry.slope * entry.slope).sqrt();
        let sin = entry.slope * cos;
        let penetration = (entry.rise + below) * cos;
        let result = &mut forces.patches[which];
        result.penetration = penetration;
        result.s = entry.s;
        result.radius = pair.installation.wheel_radius + entry.z;
        if penetration <= 0.0 || entry.stiffness <= 0.0 {
            return;
        }
        let root = penetration.sqrt();
        let load = entry.stiffness * penetration * root;
        let point = frame.point(
            pair.installation.datum() + entry.s,
            result.radius,
            entry.slope,
        );
        let ([x, y, z], turning) = (point, frame.turning);
        let along = frame.velocity[0] + turning[1] * z - turning[2] * y;
        let aside = frame.velocity[1] - rail.lateral_rate + turning[2] * x - turning[0] * z;
        let down = frame.velocity[2] - rail.vertical_rate + turning[0] * y - turning[1] * x;
        let way = frame.way;
        let creepage = Creepage {
            longitudinal: way * along * frame.per_speed,
            lateral: way * (aside * cos + down * sin) * frame.per_speed,
            spin: (turning[2] * cos - turning[1] * sin) * frame.per_speed,
        }
        .finite();
        let contact = LoadedContact {
            load,
            a: entry.rolling * root,
            b: entry.across * root,
            shear: self.shear,
            kalker: entry.kalker,
            friction: self.friction.at(creepage.sliding() * frame.speed),
        };
        let creep = self.law.forces(&contact, &creepage);
        let (fx, ft) = (way * creep.longitudinal, way * creep.lateral);
        let force = [fx, ft * cos + load * sin, ft * sin - load * cos];
        let moment = [
            y * force[2] - z * force[1],
            z * force[0] - x * force[2] - creep.moment * sin,
            x * force[1] - y * force[0] + creep.moment * cos,
        ];
        result.load = load;
        result.slope = -entry.slope;
        result.semi_axes = [contact.a, contact.b];
        result.point = point;
        result.creepage = creepage;
        result.creep = creep;
        result.loss = creep.loss(&creepage) * frame.speed;
        for k in 0..3 {
            forces.force[k] += force[k];
            forces.moment[k] += moment[k];
        }
        let status = if penetration > DEEPEST {
            Status::OutsideTables
        } else if entry.s < pair.tip {
            Status::PastTip
        } else if entry.s < pair.steepest {
            Status::Climbing
        } else {
            Status::Rolling
        };
        forces.status = forces.status.max(status);
    }
}
