//! Effect of the track layout on the bodies above it.

use super::block::{N, Vector};
use crate::track::{Alignment, Layout};
use crate::vehicle::GRAVITY_M_PER_S2;

/// Lateral distance between the contact points of a centred wheelset, over which cant is measured, m.
pub const CANT_BASE_M: f64 = 1.5;

/// Position of a body: longitudinal from the middle of the vehicle, and height of its centre above the top of the
/// rails, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyPosition {
    pub x_m: f64,
    pub height_m: f64,
}

/// The track frame under each body, in the order of the body's coordinates.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Guidance {
    /// Displacement and rotation of the body's centre by the frame since the distance 0.
    pub pose: Vec<Vector>,
    /// Rate of `pose`.
    pub pose_rate: Vec<Vector>,
    /// Pose of the body's frame relative to the frame at the middle of the vehicle, in which elements are defined.
    pub relative: Vec<Vector>,
    /// Rate of `relative`.
    pub relative_rate: Vec<Vector>,
    /// Gravity and centrifugal acceleration in excess of those on straight level track.
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
    fn new(alignment: &Alignment, speed_m_per_s: f64) -> Self {
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

/// Arc sine by its series; the error is below 2e-8 for the largest cant of a layout.
#[inline(always)]
fn cant_angle(sine: f64) -> f64 {
    let square = sine * sine;
    sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0))))
}

impl Guidance {
    /// Returns the frames on straight track, which are all zero.
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

    /// Updates the frames with the middle of the vehicle at `distance_m`.
    #[inline(always)]
    pub fn update(
        &mut self,
        layout: &Layout,
        distance_m: f64,
        speed_m_per_s: f64,
        positions: &[BodyPosition],
    ) {
        let middle = layout.course(distance_m);
        let middle_bank = Bank::new(&middle.alignment, speed_m_per_s);
        let middle_curvature = middle.alignment.curvature_per_m;
        let poses = self.pose.iter_mut().zip(&mut self.pose_rate);
        let relatives = self.relative.iter_mut().zip(&mut self.relative_rate);
        let frames = poses.zip(relatives).zip(&mut self.acceleration);
        for (position, (((pose, pose_rate), (relative, relative_rate)), acceleration)) in
            positions.iter().zip(frames)
        {
            let course = layout.course(distance_m + position.x_m);
            let bank = Bank::new(&course.alignment, speed_m_per_s);
            let curvature = course.alignment.curvature_per_m;
            let heading = course.heading_rad - middle.heading_rad;
            let (roll, rate) = (bank.roll - middle_bank.roll, bank.rate - middle_bank.rate);
            let offset = course.offset_m - middle.offset_m - middle.heading_rad * position.x_m;
            let height = position.height_m;
            let centripetal = speed_m_per_s * speed_m_per_s * curvature;
            // The frame has neither vertical displacement nor pitch.
            [pose[0], pose[2], pose[4]] = [height * bank.roll, bank.roll, course.heading_rad];
            let turn = speed_m_per_s * curvature;
            [pose_rate[0], pose_rate[2], pose_rate[4]] = [height * bank.rate, bank.rate, turn];
            [relative[0], relative[2], relative[4]] = [offset + height * roll, roll, heading];
            let drift = speed_m_per_s * (heading - middle_curvature * position.x_m);
            let turn = speed_m_per_s * (curvature - middle_curvature);
            [relative_rate[0], relative_rate[2], relative_rate[4]] =
                [drift + height * rate, rate, turn];
            acceleration[0] = GRAVITY_M_PER_S2 * middle_bank.sine - centripetal * bank.cosine;
            acceleration[1] =
                GRAVITY_M_PER_S2 * (middle_bank.cosine - 1.0) + centripetal * bank.sine;
        }
    }
}
