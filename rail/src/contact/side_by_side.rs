//! The step: evaluates the patches of both wheels in parallel vector lanes.
//!
//! The four lanes hold one patch of the left wheel (of its mirror image on the right side), one of the right wheel, and
//! a second patch of each. The instruction set is detected once. On processors with fused multiply-add, the last bits
//! of single precision differ from those on processors without.

use fearless_simd::{Simd, SimdBase, dispatch, f64x4};

use super::forces::{PatchForces, WheelsetForces};
use super::frame::Frame;
use super::loaded_zones::LoadedZones;
use super::motion::{Motion, MotionNumbers, RailDisplacement, RailNumbers};
use super::silhouette::WheelPose;
use super::source::{PatchReader, PatchSource};
use super::wheel::{MovingWheel, PatchOutput, Wrench, status};
use super::wheelset::WheelsetContact;
use crate::creep::CreepLaw;
use crate::math::each::Each;
use crate::math::number::{Number, load, rows};

/// Factor of each lane for quantities that change sign when mirrored about the track centre.
const SIDES: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];

#[inline(always)]
fn numbers<S: Simd>(simd: S, motion: &Motion) -> MotionNumbers<f64x4<S>> {
    let sides = load(simd, &SIDES);
    MotionNumbers::new(
        motion,
        |value, _| simd.splat_f64x4(value),
        |value, _| simd.splat_f64x4(value) * sides,
    )
}

#[inline(always)]
fn rail_numbers<S: Simd>(simd: S, [left, right]: &[RailDisplacement; 2]) -> RailNumbers<f64x4<S>> {
    RailNumbers::new(
        |field| {
            load(
                simd,
                &[field(left), field(right), field(left), field(right)],
            )
        },
        |field| {
            let lanes = [-field(left), field(right), -field(left), field(right)];
            load(simd, &lanes)
        },
    )
}

/// Patch results, transposed so that a lane is stored in four vectors.
struct TransposedOutput<S: Simd> {
    /// Four results per vector, one vector for each lane.
    fours: [[f64x4<S>; 4]; 4],
    dissipation: f64x4<S>,
    peak_pressure: f64x4<S>,
    stiffness: f64x4<S>,
}

impl<S: Simd> TransposedOutput<S> {
    #[inline(always)]
    fn new(output: PatchOutput<f64x4<S>>) -> Self {
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
    fn write(&self, lane: usize, patch: &mut PatchForces) {
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
fn ones(used: [bool; 4]) -> [f64; 4] {
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
fn located<'a, S: Simd, P: PatchSource>(
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

impl<L: CreepLaw, P: PatchSource> WheelsetContact<L, P> {
    /// Implements [`WheelsetContact::update`]. If `MANY`, a loop handles any number of patches. Otherwise there is no
    /// loop, and wheels with more than two patches make it return false.
    #[inline(always)]
    pub(super) fn update_side_by_side<const MANY: bool, S: Simd>(
        &self,
        simd: S,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) -> bool {
        if !forces.begin(motion, rails) {
            return true;
        }
        let on_rails = rail_numbers(simd, rails);
        let moving = MovingWheel::new(
            Frame::new(&numbers(simd, motion), &on_rails),
            on_rails,
            self.lengths_in_lanes.map(|lengths| load(simd, lengths)),
        );
        let sources = [self.sources[0].as_ref(), self.sources[1].as_ref()];
        let left_reader = &located(simd, sources[0], &moving, 0);
        let right_reader = &located(simd, sources[1], &moving, 1);
        let [left, right] = &mut forces.wheels;
        let loaded = [left_reader.loaded_zones(), right_reader.loaded_zones()];
        let [p, q] = [left_reader.approach_m(), right_reader.approach_m()];
        let approach = load(simd, &[p, q, p, q]).not_negative();
        let [p, q] = [left_reader.growth_per_m(), right_reader.growth_per_m()];
        let growth = load(simd, &[p, q, p, q]);
        let mut left_zones = LoadedZones::new(loaded[0], left);
        let mut right_zones = LoadedZones::new(loaded[1], right);
        // One lane for each wheel.
        let mut wrench = Wrench::splat(simd.splat_f64x2(0.0));
        let mut penetration = simd.splat_f64x4(0.0);
        let mut wheel_y = simd.splat_f64x4(f64::MAX);
        while left_zones.are_left() | right_zones.are_left() {
            // A lane without a patch repeats the wheel's last patch with zero load.
            let [(a, p), (b, q)] = [left_zones.advance(), right_zones.advance()];
            let [(c, r), (d, s)] = [left_zones.advance(), right_zones.advance()];
            if !MANY && (left_zones.are_left() | right_zones.are_left()) {
                return false;
            }
            let used = [p, q, r, s];
            let mut numbers =
                P::Reader::numbers_in_lanes(simd, [left_reader, right_reader], [a, b, c, d]);
            numbers.load *= load(simd, &ones(used));
            let patch = moving.patch(&self.surface, [approach, growth], numbers, used);
            wrench.accumulate(&patch.wrench, |sum, term| {
                let (first, second) = simd.split_f64x4(term);
                sum + (first + second)
            });
            penetration = penetration.max(patch.output.penetration);
            wheel_y = wheel_y.min(patch.output.wheel_y);
            let output = TransposedOutput::new(patch.output);
            if p {
                output.write(0, &mut left.patches[a]);
            }
            if q {
                output.write(1, &mut right.patches[b]);
            }
            if r {
                output.write(2, &mut left.patches[c]);
            }
            if s {
                output.write(3, &mut right.patches[d]);
            }
            if !MANY {
                break;
            }
        }
        let inside = [left_reader.is_inside(), right_reader.is_inside()];
        for side in 0..2 {
            forces.wheels[side].status = status(
                sources[side].geometry().pair(),
                inside[side],
                loaded[side] != 0,
                penetration[side].max(penetration[side + 2]),
                wheel_y[side].min(wheel_y[side + 2]),
            );
        }
        forces.set_wrenches(wrench.map(|sum| sum.into()));
        true
    }

    /// [`WheelsetContact::update`] for any number of patches.
    #[cold]
    #[inline(never)]
    pub(super) fn update_many(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) {
        dispatch!(self.level, simd => self.update_side_by_side::<true, _>(simd, motion, rails, forces));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use fearless_simd::Level;

    use super::*;
    use crate::contact::{ContactGeometry, Installation, Pair, Steel, Tables};
    use crate::creep::{Friction, KalkerBook};

    #[test]
    fn baseline_instructions_give_the_same_forces() {
        let pair = Pair::standard(Installation::default()).unwrap();
        let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
        let tables = Arc::new(Tables::new(geometry));
        let new = WheelsetContact::new(tables, KalkerBook::new(), Friction::default()).unwrap();
        let old = WheelsetContact {
            level: Level::baseline(),
            ..new.clone()
        };
        for step in 0..200 {
            let motion = Motion {
                speed_m_per_s: 20.0,
                rotation_rad_per_s: 32.01,
                lateral_m: 4e-5 * f64::from(step),
                vertical_m: 0.25e-3,
                yaw_rad: 2e-3 + 1e-5 * f64::from(step),
                ..Motion::default()
            };
            let rails = [RailDisplacement::default(); 2];
            let (new, old) = (new.forces(&motion, &rails), old.forces(&motion, &rails));
            assert!(old.force_n[2] < -10e3);
            for k in 0..3 {
                assert!((new.force_n[k] - old.force_n[k]).abs() < 1e-5 * -old.force_n[2]);
                assert!((new.moment_n_m[k] - old.moment_n_m[k]).abs() < 1e-5 * -old.force_n[2]);
            }
        }
    }
}
