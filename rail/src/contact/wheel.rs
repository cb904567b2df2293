//! Where a wheel is over its rail, and the force of one patch on it.

use super::forces::{Status, TOLD};
use super::frame::{Frame, RailRoll};
use super::geometry::ContactGeometry;
use super::loaded_contact::{Contact, CreepNumber};
use super::motion::RailNumbers;
use super::pair::Pair;
use super::surface::Surface;
use super::tables::NUMBERS;
use crate::creep::{CreepLaw, MAX_CREEPAGE};
use crate::math::number::Number;

/// Normal penetration beyond which steel does not stay elastic, m.
pub const MAX_PENETRATION_M: f64 = 2e-3;

/// Force, N, and moment about the wheelset's centre, N m, in track axes.
pub(super) type Wrench<T> = [T; 6];

/// Lengths of a wheel over its rail, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct WheelLengths<T> {
    /// Lateral distance of the tread datum from the wheelset's centre.
    offset: T,
    radius: T,
    /// Nominal radius less the height of the wheelset's centre above the rails' top in its nominal position.
    below_top: T,
    /// Lateral distance of the datum of a centred wheel from the rail's top.
    beside_top: T,
}

impl WheelLengths<f64> {
    /// Those of the wheels of a geometry, whose wheelset is `height_m` above the rails.
    pub fn new(geometry: &ContactGeometry, height_m: f64) -> Self {
        let pair = geometry.pair();
        let offset = pair.installation().datum_offset_m();
        let radius = pair.installation().wheel_radius_m;
        Self {
            offset,
            radius,
            below_top: radius - height_m,
            beside_top: offset - pair.rail_top_m(),
        }
    }
}

impl<T> WheelLengths<T> {
    /// The same with every number made another.
    #[inline(always)]
    pub fn map<U>(&self, number: impl Fn(&T) -> U) -> WheelLengths<U> {
        WheelLengths {
            offset: number(&self.offset),
            radius: number(&self.radius),
            below_top: number(&self.below_top),
            beside_top: number(&self.beside_top),
        }
    }

    /// Those of two wheels side by side.
    pub fn zip<U>(&self, other: &Self, number: impl Fn(&T, &T) -> U) -> WheelLengths<U> {
        WheelLengths {
            offset: number(&self.offset, &other.offset),
            radius: number(&self.radius, &other.radius),
            below_top: number(&self.below_top, &other.below_top),
            beside_top: number(&self.beside_top, &other.beside_top),
        }
    }
}

/// Where a wheel is over its rail.
pub(super) struct Place<T> {
    frame: Frame<T>,
    rail: RailNumbers<T>,
    rail_roll: RailRoll<T>,
    lengths: WheelLengths<T>,
    /// Shift, roll and yaw.
    pub pose: [T; 3],
    /// Depth of the tread datum below the rail's top, m.
    pub depth: T,
}

/// One patch: its force and what is told of it.
pub(super) struct Patch<T> {
    pub wrench: Wrench<T>,
    pub penetration: T,
    pub wheel_y: T,
    /// The numbers of [`PatchForces`](super::PatchForces), of a patch of the right side.
    pub told: [T; TOLD],
}

impl<T: CreepNumber> Place<T> {
    #[inline(always)]
    pub fn new(frame: Frame<T>, rail: RailNumbers<T>, lengths: WheelLengths<T>) -> Self {
        let [lateral, vertical] = frame.datum_displacement(lengths.offset, lengths.radius);
        let rail_roll = RailRoll::of(&rail);
        let [across, depth] = rail_roll.into_rail([
            lateral + lengths.beside_top - rail.lateral,
            vertical + lengths.below_top - rail.vertical,
        ]);
        Self {
            pose: [
                across - lengths.beside_top,
                frame.roll - rail_roll.angle,
                frame.yaw,
            ],
            depth,
            frame,
            rail,
            rail_roll,
            lengths,
        }
    }

    /// The patch of `numbers` whose surfaces interpenetrate by `depth` along z, in the lanes that are `used`.
    #[inline(always)]
    pub fn patch<L: CreepLaw>(
        &self,
        surface: &Surface<L>,
        depth: T,
        numbers: [T; NUMBERS],
        used: [bool; 4],
    ) -> Patch<T> {
        let (frame, rail) = (&self.frame, &self.rail);
        let [
            wheel_y,
            wheel_z,
            rail_slope,
            fraction,
            stiffness,
            a,
            b,
            c11,
            c22,
            c23,
            c33,
            _,
        ] = numbers;
        let penetration = depth * cosine(rail_slope);
        let slope = self.rail_roll.into_track(rail_slope);
        let cos = cosine(slope);
        let sin = slope * cos;
        let radius = wheel_z + self.lengths.radius;
        let position = frame.silhouette_point(wheel_y + self.lengths.offset, radius, slope);
        let ([x, y, z], [wx, wy, wz]) = (position, frame.angular_velocity);
        // Velocity of the wheel's surface relative to the rail, which turns about its top.
        let beside_top = self.pose[0] + wheel_y + self.lengths.beside_top;
        let below_top = self.depth + wheel_z;
        let vx = frame.velocity[0] + wy * z - wz * y;
        let vy = frame.velocity[1] + wz * x - wx * z + below_top * rail.roll_rate
            - rail.lateral_velocity;
        let vz = frame.velocity[2] + wx * y
            - wy * x
            - beside_top * rail.roll_rate
            - rail.vertical_velocity;
        let directed = frame.per_reference_speed * frame.direction;
        let root = penetration.sqrt();
        let approach_speed = vz * cos - vy * sin;
        // A patch that is part of another is a fraction of it, in its creep forces too.
        let contact = Contact {
            load: stiffness * penetration * root * surface.damping(approach_speed),
            fraction,
            semi_axes: [a * root, b * root],
            kalker: [c11, c22, c23, c33],
            creepage: [
                (vx * directed).limited(MAX_CREEPAGE),
                ((vy * cos + vz * sin) * directed).limited(MAX_CREEPAGE),
                ((wz * cos - wy * sin) * frame.per_reference_speed).limited(MAX_CREEPAGE),
            ],
        };
        let creep = T::creep_forces(&contact, surface, frame.reference_speed, used);
        let [longitudinal, lateral, spin_moment] = creep;
        let [xi, eta, phi] = contact.creepage;
        let dissipation =
            -(longitudinal * xi + lateral * eta + spin_moment * phi) * frame.reference_speed;
        let load = contact.load * fraction;
        let (fx, ft) = (longitudinal * frame.direction, lateral * frame.direction);
        let (fy, fz) = (ft * cos + load * sin, ft * sin - load * cos);
        Patch {
            wrench: [
                fx,
                fy,
                fz,
                y * fz - z * fy,
                z * fx - x * fz - spin_moment * sin,
                x * fy - y * fx + spin_moment * cos,
            ],
            penetration,
            wheel_y,
            told: [
                load,
                penetration,
                -slope,
                contact.semi_axes[0],
                contact.semi_axes[1],
                radius,
                wheel_y,
                x,
                y,
                z,
                xi,
                eta,
                phi,
                longitudinal,
                lateral,
                spin_moment,
                dissipation,
            ],
        }
    }
}

/// State of a wheel at a pose inside its tables or not, with the greatest penetration of its patches and the `wheel_y_m` of the
/// one nearest to the flange's tip, if it is loaded.
#[inline(always)]
pub(super) fn status(
    pair: &Pair,
    is_inside: bool,
    is_loaded: bool,
    penetration_m: f64,
    wheel_y_m: f64,
) -> Status {
    if !is_inside || penetration_m > MAX_PENETRATION_M {
        Status::OutsideTables
    } else if !is_loaded {
        Status::Lifted
    } else if wheel_y_m < pair.flange_tip_m() {
        Status::PastTip
    } else if wheel_y_m < pair.steepest_flange_m() {
        Status::Climbing
    } else {
        Status::Rolling
    }
}

/// Cosine of the angle whose tangent is `slope`.
#[inline(always)]
fn cosine<T: Number>(slope: T) -> T {
    (slope * slope + 1.0).sqrt().reciprocal()
}
