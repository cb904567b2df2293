//! Contact forces on a wheelset: tables, Hertz and a creep law for each of its four patches.

use super::creepage::{CreepForces, CreepLaw, Creepage, LoadedContact};
use super::friction::Friction;
use super::kalker::Coefficients;
use super::pair::Place;
use super::table::{Entry, Tables};

/// Motion of a wheelset in the track's axes; turned by the yaw, then rolled about the rail's direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Speed along the track, m/s.
    pub speed: f64,
    /// Lateral place of the centre, right positive, m.
    pub lateral: f64,
    /// Depth of the centre below its place with the tread datum at the rails' top, m.
    pub vertical: f64,
    /// Roll, right side down positive, rad.
    pub roll: f64,
    /// Yaw, nose to the right positive, rad.
    pub yaw: f64,
    /// Rate of `lateral`, m/s.
    pub lateral_rate: f64,
    /// Rate of `vertical`, m/s.
    pub vertical_rate: f64,
    /// Rate of roll, rad/s.
    pub roll_rate: f64,
    /// Turning about the axle, rolling forward positive, rad/s; free rolling is `speed / radius`.
    pub rotation: f64,
    /// Rate of yaw over ground, rad/s: in a curve to the right of radius `R` the frame's own `speed / R` is part of it.
    pub yaw_rate: f64,
}

/// Place of one rail against its nominal one (irregularity, own movement).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rail {
    /// To the right, m.
    pub lateral: f64,
    /// Downward, m.
    pub vertical: f64,
    /// Rate of `lateral` as seen by the wheelset, `speed` times the rail's slope and its own movement, m/s.
    pub lateral_rate: f64,
    /// Rate of `vertical`, m/s.
    pub vertical_rate: f64,
}

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

/// Normal penetration beyond which steel does not stay elastic, m.
const DEEPEST: f64 = 2e-3;

/// Least speed creepages are taken over, m/s: at rest the creep forces become a viscous drag.
pub const STANDSTILL: f64 = 0.05;

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

/// The contact of a wheelset: constant, shared by every wheelset of the same pair.
#[derive(Debug, Clone)]
pub struct WheelsetContact<L> {
    tables: Tables,
    law: L,
    friction: Friction,
}

impl<L: CreepLaw> WheelsetContact<L> {
    /// Contact by `tables`, `law` and `friction`.
    pub fn new(tables: Tables, law: L, friction: Friction) -> Self {
        Self {
            tables,
            law,
            friction,
        }
    }

    /// The tables in use.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// Forces on a wheelset in `motion` over the left and the right rail. Does not allocate.
    pub fn forces(&self, motion: &Motion, rails: &[Rail; 2]) -> WheelsetForces {
        let mut forces = WheelsetForces::default();
        let [left, right] = &mut forces.wheels;
        self.wheel(&mirrored(motion), &mirrored_rail(&rails[0]), left);
        mirror(left);
        self.wheel(motion, &rails[1], right);
        for k in 0..3 {
            forces.force[k] = left.force[k] + right.force[k];
            forces.moment[k] = left.moment[k] + right.moment[k];
        }
        forces.status = left.status.max(right.status);
        forces
    }

    /// Forces on the right wheel.
    #[inline]
    fn wheel(&self, motion: &Motion, rail: &Rail, forces: &mut WheelForces) {
        if !all_finite(motion, rail) {
            forces.status = Status::NotFinite;
            return;
        }
        let installation = &self.tables.pair().installation;
        let (datum, radius) = (installation.datum(), installation.wheel_radius);
        let attitude = Attitude::new(motion);
        let place = Place {
            lateral: motion.lateral - rail.lateral
                + datum * (attitude.cos_roll * attitude.cos_yaw - 1.0)
                - radius * attitude.sin_roll,
            roll: motion.roll,
            yaw: motion.yaw,
        };
        let below = motion.vertical - rail.vertical
            + datum * attitude.sin_roll * attitude.cos_yaw
            + radius * (attitude.cos_roll - 1.0);
        let (entries, inside) = self.tables.at(&place);
        if !inside {
            forces.status = Status::OutsideTables;
        }
        for (patch, entry) in entries.iter().enumerate() {
            self.patch(motion, rail, &attitude, entry, below, patch, forces);
        }
    }

    /// Adds one patch to the wheel's `forces`.
    #[inline]
    #[allow(clippy::too_many_arguments)]
    fn patch(
        &self,
        motion: &Motion,
        rail: &Rail,
        attitude: &Attitude,
        entry: &Entry,
        below: f64,
        which: usize,
        forces: &mut WheelForces,
    ) {
        let installation = &self.tables.pair().installation;
        let cos = 1.0 / (1.0 + entry.slope * entry.slope).sqrt();
        let sin = entry.slope * cos;
        let penetration = (entry.rise + below) * cos;
        let result = &mut forces.patches[which];
        result.penetration = penetration;
        result.s = entry.s;
        result.radius = installation.wheel_radius + entry.z;
        if penetration <= 0.0 || entry.stiffness <= 0.0 {
            return;
        }
        let root = penetration.sqrt();
        let load = entry.stiffness * penetration * root;
        let point = attitude.point(installation.datum() + entry.s, result.radius, entry.slope);
        let [x, y, z] = point;
        // Turning in track axes: roll rate about x, yaw rate about z, rotation backwards about the axle.
        let axle = attitude.axle();
        let turning = [
            motion.roll_rate - motion.rotation * axle[0],
            -motion.rotation * axle[1],
            motion.yaw_rate - motion.rotation * axle[2],
        ];
        let velocity = [
            motion.speed + turning[1] * z - turning[2] * y,
            motion.lateral_rate - rail.lateral_rate + turning[2] * x - turning[0] * z,
            motion.vertical_rate - rail.vertical_rate + turning[0] * y - turning[1] * x,
        ];
        let along = velocity[0];
        let across = velocity[1] * cos + velocity[2] * sin;
        let spin = turning[2] * cos - turning[1] * sin;
        let speed = attitude.speed;
        // Rolling backwards is rolling forwards, turned half around the normal.
        let way = if motion.speed < 0.0 { -1.0 } else { 1.0 };
        let creepage = Creepage {
            longitudinal: way * along * attitude.per_speed,
            lateral: way * across * attitude.per_speed,
            spin: spin * attitude.per_speed,
        }
        .finite();
        let contact = LoadedContact {
            load,
            a: entry.rolling * root,
            b: entry.across * root,
            shear: self.tables.steel().shear(),
            kalker: Coefficients {
                c11: entry.kalker[0],
                c22: entry.kalker[1],
                c23: entry.kalker[2],
                c33: entry.kalker[3],
            },
            friction: self.friction.at(creepage.sliding() * speed),
        };
        let creep = self.law.forces(&contact, &creepage);
        let (fx, ft) = (way * creep.longitudinal, way * creep.lateral);
        let force = [fx, ft * cos + load * sin, ft * sin - load * cos];
        result.load = load;
        result.slope = -entry.slope;
        result.semi_axes = [contact.a, contact.b];
        result.point = point;
        result.creepage = creepage;
        result.creep = creep;
        result.loss = creep.loss(&creepage) * speed;
        let moment = [
            y * force[2] - z * force[1],
            z * force[0] - x * force[2] - creep.moment * sin,
            x * force[1] - y * force[0] + creep.moment * cos,
        ];
        for k in 0..3 {
            forces.force[k] += force[k];
            forces.moment[k] += moment[k];
        }
        let pair = self.tables.pair();
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

/// What both patches of a wheel share of its motion.
struct Attitude {
    sin_roll: f64,
    cos_roll: f64,
    tan_roll: f64,
    sin_yaw: f64,
    cos_yaw: f64,
    tan_yaw: f64,
    /// Speed creepages are taken over, m/s, and its inverse.
    speed: f64,
    per_speed: f64,
}

impl Attitude {
    #[inline]
    fn new(motion: &Motion) -> Self {
        let (sin_roll, cos_roll) = sine_and_cosine(motion.roll);
        let (sin_yaw, cos_yaw) = sine_and_cosine(motion.yaw);
        let speed = (motion.speed * motion.speed + STANDSTILL * STANDSTILL).sqrt();
        Self {
            sin_roll,
            cos_roll,
            tan_roll: sin_roll / cos_roll,
            sin_yaw,
            cos_yaw,
            tan_yaw: sin_yaw / cos_yaw,
            speed,
            per_speed: 1.0 / speed,
        }
    }

    /// Direction of the axle to the right.
    #[inline]
    fn axle(&self) -> [f64; 3] {
        [
            -self.sin_yaw,
            self.cos_yaw * self.cos_roll,
            self.cos_yaw * self.sin_roll,
        ]
    }

    /// The point of the silhouette, from the wheelset's centre, `offset` along the axle on the
    /// circle of `radius`, where the outline has `slope` across the track.
    #[inline]
    fn point(&self, offset: f64, radius: f64, slope: f64) -> [f64; 3] {
        let own = (slope - self.tan_roll) / (1.0 + slope * self.tan_roll);
        let turned = (own * self.tan_yaw).clamp(-0.9, 0.9);
        let behind = -radius * turned;
        let deep = radius * (1.0 - turned * turned).sqrt();
        let across = behind * self.sin_yaw + offset * self.cos_yaw;
        [
            behind * self.cos_yaw - offset * self.sin_yaw,
            across * self.cos_roll - deep * self.sin_roll,
            across * self.sin_roll + deep * self.cos_roll,
        ]
    }
}

/// Sine and cosine of an angle held within 0.3 rad; off by less than 5e-8 there, 3e-11 within 0.1 rad.
#[inline]
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    let x = angle.clamp(-0.3, 0.3);
    let square = x * x;
    let sine = x * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    (sine, (1.0 - sine * sine).sqrt())
}

/// Whether every number of the motion lies within a thousand million, where no square overflows.
#[inline]
fn all_finite(motion: &Motion, rail: &Rail) -> bool {
    [
        motion.speed,
        motion.lateral,
        motion.vertical,
        motion.roll,
        motion.yaw,
        motion.lateral_rate,
        motion.vertical_rate,
        motion.roll_rate,
        motion.rotation,
        motion.yaw_rate,
        rail.lateral,
        rail.vertical,
        rail.lateral_rate,
        rail.vertical_rate,
    ]
    .iter()
    .all(|number| number.abs() <= 1e9)
}

/// The motion seen in a mirror on the track's middle.
#[inline]
fn mirrored(motion: &Motion) -> Motion {
    Motion {
        lateral: -motion.lateral,
        roll: -motion.roll,
        yaw: -motion.yaw,
        lateral_rate: -motion.lateral_rate,
        roll_rate: -motion.roll_rate,
        yaw_rate: -motion.yaw_rate,
        ..*motion
    }
}

#[inline]
fn mirrored_rail(rail: &Rail) -> Rail {
    Rail {
        lateral: -rail.lateral,
        lateral_rate: -rail.lateral_rate,
        ..*rail
    }
}

/// Turns the forces of the mirror image into those of the wheel itself.
#[inline]
fn mirror(wheel: &mut WheelForces) {
    wheel.force[1] = -wheel.force[1];
    wheel.moment[0] = -wheel.moment[0];
    wheel.moment[2] = -wheel.moment[2];
    for patch in &mut wheel.patches {
        patch.point[1] = -patch.point[1];
    }
}
