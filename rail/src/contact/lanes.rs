//! Four vector lanes, each with a wheel: the left one (its mirror image on the right side), the right one, and both
//! again, of the same wheelset or of another.

use fearless_simd::{Simd, f64x4};

use super::forces::PatchForces;
use super::silhouette::WheelPose;
use super::source::PatchSource;
use super::wheel::{MovingWheel, PatchOutput};
use crate::math::each::Each;
use crate::math::number::{Number, load, rows};

/// Factor of each lane for quantities that change sign when mirrored about the track centre.
pub(super) const SIDES: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];

/// Patch results, transposed so that a lane is stored in four vectors.
pub(super) struct TransposedOutput<S: Simd> {
    /// Four results per vector, one vector for each lane.
    fours: [[f64x4<S>; 4]; 4],
    dissipation: f64x4<S>,
    peak_pressure: f64x4<S>,
    stiffness: f64x4<S>,
}

impl<S: Simd> TransposedOutput<S> {
    #[inline(always)]
    pub fn new(output: PatchOutput<f64x4<S>>) -> Self {
        let PatchOutput {
            load: normal_load,
            penetration,
            slope,
            semi_axes: [a, b],
            rolling_radius,
            wheel_y,
            position: [x, y, z],
            creepage: [xi, eta, phi],
            creep: [longitudinal, lateral, moment],
            dissipation,
            peak_pressure,
            stiffness,
        } = output;
        let y = y * load(y.simd, &SIDES);
        Self {
            fours: [
                rows([normal_load, penetration, slope, a]),
                rows([b, rolling_radius, wheel_y, x]),
                rows([y, z, xi, eta]),
                rows([phi, longitudinal, lateral, moment]),
            ],
            dissipation,
            peak_pressure,
            stiffness,
        }
    }

    #[inline(always)]
    pub fn write(&self, lane: usize, patch: &mut PatchForces) {
        let [first, second, third, fourth] = &self.fours;
        let [load, penetration, slope, a] = first[lane].into();
        let [b, rolling_radius, wheel_y, x] = second[lane].into();
        let [y, z, xi, eta] = third[lane].into();
        let [phi, longitudinal, lateral, moment] = fourth[lane].into();
        patch.set(PatchOutput {
            load,
            penetration,
            slope,
            semi_axes: [a, b],
            rolling_radius,
            wheel_y,
            position: [x, y, z],
            creepage: [xi, eta, phi],
            creep: [longitudinal, lateral, moment],
            dissipation: self.dissipation[lane],
            peak_pressure: self.peak_pressure[lane],
            stiffness: self.stiffness[lane],
        });
    }
}

/// 1 in the lanes that are used, else 0. A table costs less than converting the booleans.
#[inline(always)]
pub(super) fn ones(used: [bool; 4]) -> [f64; 4] {
    const ONES: [[f64; 4]; 16] = {
        let mut ones = [[0.0; 4]; 16];
        let mut k = 0;
        while k < 64 {
            ones[k / 4][k % 4] = ((k / 4) >> (k % 4) & 1) as f64;
            k += 1;
        }
        ones
    };
    let [a, b, c, d] = used.each(usize::from);
    ONES[a | b << 1 | c << 2 | d << 3]
}

/// Finds the patches of the wheel in a lane.
// Not a closure, because a closure that is called twice is not inlined.
#[inline(always)]
pub(super) fn located<'a, S: Simd, P: PatchSource>(
    simd: S,
    source: &'a P,
    moving: &MovingWheel<f64x4<S>>,
    lane: usize,
) -> P::Reader<'a> {
    let [lateral_m, roll_rad, yaw_rad] = moving.pose.each(|number| number.lane(lane));
    let pose = WheelPose {
        lateral_m,
        roll_rad,
        yaw_rad,
    };
    source.locate(simd, &pose, moving.depth.lane(lane))
}
