//! What the layout of the track does to the bodies above it.

use super::blocks::Vector;
use crate::track::Layout;
use crate::vehicle::GRAVITY_M_PER_S2;

/// Lateral distance of the contact points of a centred wheelset, over which cant is measured, m.
pub const CANT_BASE_M: f64 = 1.5;

/// Where a body stands: longitudinal place from the middle of the vehicle, and height of its centre above the rails' top, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stand {
    pub x_m: f64,
    pub height_m: f64,
}

/// The track frame under a body, in the order of its coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Guidance {
    /// How far the frame has moved and turned the body's centre since the distance 0: what its own velocities lack.
    pub pose: Vector,
    /// Rate of `pose`.
    pub pose_rate: Vector,
    /// Place of the body's frame in that of the middle of the vehicle, in which elements lie.
    pub relative: Vector,
    /// Rate of `relative`.
    pub relative_rate: Vector,
    /// Weight and centripetal force over the mass, beyond those of straight level track.
    pub acceleration: Vector,
}

/// Angle whose sine is cant over its base, by the series of the arc sine: within 2e-8 for the greatest cant of a layout.
#[inline(always)]
fn cant_angle(sine: f64) -> f64 {
    let square = sine * sine;
    sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0))))
}

impl Guidance {
    /// Of bodies at their stands, the middle of the vehicle at `distance_m`.
    #[inline(always)]
    pub fn update(
        layout: &Layout,
        distance_m: f64,
        speed_m_per_s: f64,
        stands: &[Stand],
        guidance: &mut [Self],
    ) {
        let middle = layout.course(distance_m);
        let sine = middle.alignment.cant_m / CANT_BASE_M;
        let cosine = (1.0 - sine * sine).sqrt();
        let roll = cant_angle(sine);
        let roll_rate = speed_m_per_s * middle.alignment.cant_slope / (CANT_BASE_M * cosine);
        let middle_curvature = middle.alignment.curvature_per_m;
        for (stand, guidance) in stands.iter().zip(guidance) {
            let course = layout.course(distance_m + stand.x_m);
            let own_sine = course.alignment.cant_m / CANT_BASE_M;
            let own_cosine = (1.0 - own_sine * own_sine).sqrt();
            let own_roll = cant_angle(own_sine);
            let own_rate = speed_m_per_s * course.alignment.cant_slope / (CANT_BASE_M * own_cosine);
            let curvature = course.alignment.curvature_per_m;
            let heading = course.heading_rad - middle.heading_rad;
            let (relative_roll, relative_rate) = (own_roll - roll, own_rate - roll_rate);
            let offset = course.offset_m - middle.offset_m - middle.heading_rad * stand.x_m;
            let centripetal = speed_m_per_s * speed_m_per_s * curvature;
            *guidance = Self {
                pose: [
                    stand.height_m * own_roll,
                    0.0,
                    own_roll,
                    0.0,
                    course.heading_rad,
                ],
                pose_rate: [
                    stand.height_m * own_rate,
                    0.0,
                    own_rate,
                    0.0,
                    speed_m_per_s * curvature,
                ],
                relative: [
                    offset + stand.height_m * relative_roll,
                    0.0,
                    relative_roll,
                    0.0,
                    heading,
                ],
                relative_rate: [
                    speed_m_per_s * (heading - middle_curvature * stand.x_m)
                        + stand.height_m * relative_rate,
                    0.0,
                    relative_rate,
                    0.0,
                    speed_m_per_s * (curvature - middle_curvature),
                ],
                acceleration: [
                    GRAVITY_M_PER_S2 * sine - centripetal * own_cosine,
                    GRAVITY_M_PER_S2 * (cosine - 1.0) + centripetal * own_sine,
                    0.0,
                    0.0,
                    0.0,
                ],
            };
        }
    }
}
