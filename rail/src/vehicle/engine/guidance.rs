//! What the layout of the track does to the bodies above it.

use super::block::{N, Vector};
use crate::track::{Alignment, Layout};
use crate::vehicle::GRAVITY_M_PER_S2;

/// Lateral distance of the contact points of a centred wheelset, over which cant is measured, m.
pub const CANT_BASE_M: f64 = 1.5;

/// Where a body stands: longitudinal place from the middle of the vehicle, and height of its centre above the rails' top, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stand {
    pub x_m: f64,
    pub height_m: f64,
}

/// The track frame under each body, in the order of its coordinates.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Guidance {
    /// How far the frame has moved and turned the body's centre since the distance 0: what its own velocities lack.
    pub pose: Vec<Vector>,
    /// Rate of `pose`.
    pub pose_rate: Vec<Vector>,
    /// Place of the body's frame in that of the middle of the vehicle, in which elements lie.
    pub relative: Vec<Vector>,
    /// Rate of `relative`.
    pub relative_rate: Vec<Vector>,
    /// Weight and centripetal force over the mass, beyond those of straight level track.
    pub acceleration: Vec<Vector>,
}

/// The cant as an angle.
#[derive(Debug, Clone, Copy)]
struct Bank {
    sine: f64,
    cosine: f64,
    roll: f64,
    rate: f64,
}

impl Bank {
    #[inline(always)]
    fn of(alignment: &Alignment, speed_m_per_s: f64) -> Self {
        let sine = alignment.cant_m / CANT_BASE_M;
        let cosine = (1.0 - sine * sine).sqrt();
        Self {
            sine,
            cosine,
            roll: cant_angle(sine),
            rate: speed_m_per_s * alignment.cant_slope / (CANT_BASE_M * cosine),
        }
    }
}

/// Angle whose sine is cant over its base, by the series of the arc sine: within 2e-8 for the greatest cant of a layout.
#[inline(always)]
fn cant_angle(sine: f64) -> f64 {
    let square = sine * sine;
    sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0))))
}

impl Guidance {
    /// On straight track.
    pub fn new(bodies: usize) -> Self {
        let zeros = vec![[0.0; N]; bodies];
        Self {
            pose: zeros.clone(),
            pose_rate: zeros.clone(),
            relative: zeros.clone(),
            relative_rate: zeros.clone(),
            acceleration: zeros,
        }
    }

    /// For bodies at their stands, the middle of the vehicle at `distance_m`.
    #[inline(always)]
    pub fn update(
        &mut self,
        layout: &Layout,
        distance_m: f64,
        speed_m_per_s: f64,
        stands: &[Stand],
    ) {
        let middle = layout.course(distance_m);
        let middle_bank = Bank::of(&middle.alignment, speed_m_per_s);
        let middle_curvature = middle.alignment.curvature_per_m;
        let poses = self.pose.iter_mut().zip(&mut self.pose_rate);
        let relatives = self.relative.iter_mut().zip(&mut self.relative_rate);
        let frames = poses.zip(relatives).zip(&mut self.acceleration);
        for (stand, (((pose, pose_rate), (relative, relative_rate)), acceleration)) in
            stands.iter().zip(frames)
        {
            let course = layout.course(distance_m + stand.x_m);
            let bank = Bank::of(&course.alignment, speed_m_per_s);
            let curvature = course.alignment.curvature_per_m;
            let heading = course.heading_rad - middle.heading_rad;
            let (roll, rate) = (bank.roll - middle_bank.roll, bank.rate - middle_bank.rate);
            let offset = course.offset_m - middle.offset_m - middle.heading_rad * stand.x_m;
            let height = stand.height_m;
            let centripetal = speed_m_per_s * speed_m_per_s * curvature;
            // Height and pitch of the frame stay zero.
            [pose[0], pose[2], pose[4]] = [height * bank.roll, bank.roll, course.heading_rad];
            let turn = speed_m_per_s * curvature;
            [pose_rate[0], pose_rate[2], pose_rate[4]] = [height * bank.rate, bank.rate, turn];
            [relative[0], relative[2], relative[4]] = [offset + height * roll, roll, heading];
            let drift = speed_m_per_s * (heading - middle_curvature * stand.x_m);
            let turn = speed_m_per_s * (curvature - middle_curvature);
            [relative_rate[0], relative_rate[2], relative_rate[4]] =
                [drift + height * rate, rate, turn];
            acceleration[0] = GRAVITY_M_PER_S2 * middle_bank.sine - centripetal * bank.cosine;
            acceleration[1] =
                GRAVITY_M_PER_S2 * (middle_bank.cosine - 1.0) + centripetal * bank.sine;
        }
    }
}
