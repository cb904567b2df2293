//! Contact forces on a wheelset: tables, Hertz and a creep law for each of its four patches.

use super::forces::{Status, WheelForces, WheelsetForces};
use super::frame::Frame;
use super::motion::{Motion, RailDisplacement};
use super::silhouette::WheelPose;
use super::tables::{Tables, TabulatedPatch};
use crate::creep::{CreepLaw, Creepage, Friction, LoadedContact};

/// Normal penetration beyond which steel does not stay elastic, m.
pub const MAX_PENETRATION_M: f64 = 2e-3;

/// The contact of a wheelset: constant, shared by every wheelset of the same pair.
///
/// ```
/// # use dashpot_rail::contact::{Grid, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact};
/// # use dashpot_rail::creep::{Friction, Polach};
/// # let mut grid = Grid::default();
/// # grid.roll_rad.cells = [1, 2, 1];
/// # grid.yaw_squared_rad2.cells = [0, 1, 1];
/// let pair = Pair::standard(Installation::default())?;
/// let tables = Tables::new(pair, Steel::default(), grid)?;
/// let contact = WheelsetContact::new(tables, Polach, Friction::default());
/// let pressed = Motion { vertical_m: 0.25e-3, ..Motion::default() };
/// let forces = contact.forces(&pressed, &[RailDisplacement::default(); 2]);
/// // The rails push up, against the axis z.
/// assert!((forces.force_n[2] / -156.3e3 - 1.0).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct WheelsetContact<L> {
    tables: Tables,
    law: L,
    friction: Friction,
    shear_modulus_pa: f64,
}

impl<L: CreepLaw> WheelsetContact<L> {
    /// The contact by `tables`, `law` and `friction`.
    pub fn new(tables: Tables, law: L, friction: Friction) -> Self {
        let shear_modulus_pa = tables.steel().shear_modulus_pa();
        Self {
            tables,
            law,
            friction,
            shear_modulus_pa,
        }
    }

    /// The tables in use.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// Forces on a wheelset in `motion` over the left and the right rail.
    ///
    /// Does not allocate and does not fail: [`Status`] reports a motion that is beyond the tables or contains NaN.
    #[inline]
    pub fn forces(&self, motion: &Motion, rails: &[RailDisplacement; 2]) -> WheelsetForces {
        let mut forces = WheelsetForces::default();
        let [left, right] = &mut forces.wheels;
        let accepted = motion.is_accepted();
        let frame = Frame::new(motion);
        self.wheel(accepted, &frame.mirrored(), &rails[0].mirrored(), left);
        left.mirror();
        self.wheel(accepted, &frame, &rails[1], right);
        for k in 0..3 {
            forces.force_n[k] = left.force_n[k] + right.force_n[k];
            forces.moment_n_m[k] = left.moment_n_m[k] + right.moment_n_m[k];
        }
        forces.status = left.status.max(right.status);
        forces
    }

    /// Forces on the right wheel, or on the mirror image of the left wheel.
    fn wheel(
        &self,
        accepted: bool,
        frame: &Frame,
        rail: &RailDisplacement,
        forces: &mut WheelForces,
    ) {
        if !(accepted && rail.is_accepted()) {
            forces.status = Status::NotFinite;
            return;
        }
        let installation = self.tables.pair().installation();
        let [lateral, vertical] =
            frame.datum_displacement(installation.datum_offset_m(), installation.wheel_radius_m);
        let pose = WheelPose {
            lateral_m: lateral - rail.lateral_m,
            roll_rad: frame.roll,
            yaw_rad: frame.yaw,
        };
        let depth = vertical - rail.vertical_m;
        let (patches, inside) = self.tables.at(&pose);
        if !inside {
            forces.status = Status::OutsideTables;
        }
        for (index, patch) in patches.iter().enumerate() {
            self.patch(frame, rail, patch, depth, index, forces);
        }
    }

    /// Adds one patch to the wheel's `forces`; `depth` is that of the tread datum below the rail's top, m.
    #[inline]
    fn patch(
        &self,
        frame: &Frame,
        rail: &RailDisplacement,
        patch: &TabulatedPatch,
        depth: f64,
        index: usize,
        forces: &mut WheelForces,
    ) {
        let pair = self.tables.pair();
        let cos = 1.0 / (1.0 + patch.slope * patch.slope).sqrt();
        let sin = patch.slope * cos;
        let penetration = (patch.interpenetration_m + depth) * cos;
        let result = &mut forces.patches[index];
        result.penetration_m = penetration;
        result.wheel_y_m = patch.wheel_y_m;
        result.rolling_radius_m = pair.installation().wheel_radius_m + patch.wheel_z_m;
        if penetration <= 0.0 || patch.hertz.stiffness_n_per_m_1_5 <= 0.0 {
            return;
        }
        let root = penetration.sqrt();
        let load = patch.hertz.stiffness_n_per_m_1_5 * penetration * root;
        let position = frame.silhouette_point(
            pair.installation().datum_offset_m() + patch.wheel_y_m,
            result.rolling_radius_m,
            patch.slope,
        );
        let ([x, y, z], [wx, wy, wz]) = (position, frame.angular_velocity);
        // Velocity of the wheel's surface relative to the rail.
        let vx = frame.velocity[0] + wy * z - wz * y;
        let vy = frame.velocity[1] - rail.lateral_velocity_m_per_s + wz * x - wx * z;
        let vz = frame.velocity[2] - rail.vertical_velocity_m_per_s + wx * y - wy * x;
        let direction = frame.direction;
        let creepage = Creepage {
            longitudinal: direction * vx * frame.per_reference_speed,
            lateral: direction * (vy * cos + vz * sin) * frame.per_reference_speed,
            spin_per_m: (wz * cos - wy * sin) * frame.per_reference_speed,
        }
        .bounded();
        let sliding_speed = creepage.magnitude() * frame.reference_speed;
        let contact = LoadedContact {
            load_n: load,
            a_m: patch.hertz.a_factor_m_0_5 * root,
            b_m: patch.hertz.b_factor_m_0_5 * root,
            shear_modulus_pa: self.shear_modulus_pa,
            kalker: patch.kalker,
            friction: self.friction.at(sliding_speed),
        };
        let creep = self.law.forces(&contact, &creepage);
        let (fx, ft) = (
            direction * creep.longitudinal_n,
            direction * creep.lateral_n,
        );
        let force = [fx, ft * cos + load * sin, ft * sin - load * cos];
        let moment = [
            y * force[2] - z * force[1],
            z * force[0] - x * force[2] - creep.moment_n_m * sin,
            x * force[1] - y * force[0] + creep.moment_n_m * cos,
        ];
        result.load_n = load;
        result.slope = -patch.slope;
        result.semi_axes_m = [contact.a_m, contact.b_m];
        result.position_m = position;
        result.creepage = creepage;
        result.creep = creep;
        result.dissipation_w = creep.dissipation_n(&creepage) * frame.reference_speed;
        for k in 0..3 {
            forces.force_n[k] += force[k];
            forces.moment_n_m[k] += moment[k];
        }
        let status = if penetration > MAX_PENETRATION_M {
            Status::OutsideTables
        } else if patch.wheel_y_m < pair.flange_tip_m() {
            Status::PastTip
        } else if patch.wheel_y_m < pair.steepest_flange_m() {
            Status::Climbing
        } else {
            Status::Rolling
        };
        forces.status = forces.status.max(status);
    }
}
