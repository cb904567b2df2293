//! Where a wheel is over its rail, and the force of one patch on it.

use super::forces::{PatchForces, Status, WheelForces};
use super::frame::{Frame, RailRoll};
use super::geometry::ContactGeometry;
use super::loaded_contact::{Contact, Creep, CreepNumber};
use super::motion::RailNumbers;
use super::pair::Pair;
use super::surface::Surface;
use super::tables::NUMBERS;
use crate::creep::CreepLaw;
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

impl<T: Number> WheelLengths<T> {
    /// Those of the wheels of one or two geometries, whose wheelset is `height_m` above the rails.
    pub fn new(geometry: impl Fn(fn(&ContactGeometry) -> f64) -> T, height_m: f64) -> Self {
        let offset = geometry(|geometry| geometry.pair().installation().datum_offset_m());
        let radius = geometry(|geometry| geometry.pair().installation().wheel_radius_m);
        Self {
            offset,
            radius,
            below_top: radius + -height_m,
            beside_top: offset - geometry(|geometry| geometry.pair().rail_top_m()),
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
    wrench: Wrench<T>,
    load: T,
    penetration: T,
    slope: T,
    radius: T,
    wheel_y: T,
    position: [T; 3],
    semi_axes: [T; 2],
    creep: [Creep; 2],
    reference_speed: T,
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

    /// The patch of `numbers` whose surfaces interpenetrate by `depth` along z.
    #[inline(always)]
    pub fn patch<L: CreepLaw>(
        &self,
        surface: &Surface<L>,
        depth: T,
        numbers: [T; NUMBERS],
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
                vx * directed,
                (vy * cos + vz * sin) * directed,
                (wz * cos - wy * sin) * frame.per_reference_speed,
            ],
        };
        let ([longitudinal, lateral, spin_moment], creep) =
            T::creep(&contact, surface, frame.reference_speed);
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
            load,
            penetration,
            slope,
            radius,
            wheel_y,
            position,
            semi_axes: contact.semi_axes,
            creep,
            reference_speed: frame.reference_speed,
        }
    }
}

impl<T: Number> Patch<T> {
    /// Adds the force and moment of the patch.
    #[inline(always)]
    pub fn add_to(&self, wrench: &mut Wrench<T>) {
        for (sum, term) in wrench.iter_mut().zip(self.wrench) {
            *sum = *sum + term;
        }
    }

    /// Writes what is told of the patch in one lane into its zone of `wheel`, whose status takes account of it.
    #[inline(always)]
    pub fn write(&self, lane: usize, pair: &Pair, zone: usize, wheel: &mut WheelForces) {
        let result = &mut wheel.patches[zone];
        result.load_n = self.load.lane(lane);
        result.penetration_m = self.penetration.lane(lane);
        result.slope = -self.slope.lane(lane);
        result.semi_axes_m = self.semi_axes.map(|axis| axis.lane(lane));
        result.rolling_radius_m = self.radius.lane(lane);
        result.wheel_y_m = self.wheel_y.lane(lane);
        result.position_m = self.position.map(|component| component.lane(lane));
        let Creep { creepage, forces } = self.creep[lane];
        result.creepage = creepage;
        result.creep = forces;
        result.dissipation_w = forces.dissipation_n(&creepage) * self.reference_speed.lane(lane);
        wheel.status = wheel.status.max(status(pair, result));
    }
}

/// What a loaded patch makes of its wheel.
#[inline(always)]
fn status(pair: &Pair, patch: &PatchForces) -> Status {
    if patch.penetration_m > MAX_PENETRATION_M {
        Status::OutsideTables
    } else if patch.wheel_y_m < pair.flange_tip_m() {
        Status::PastTip
    } else if patch.wheel_y_m < pair.steepest_flange_m() {
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
