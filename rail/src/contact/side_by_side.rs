//! The step: evaluates the patches of both wheels in parallel vector lanes.
//!
//! The four lanes hold one patch of the left wheel (of its mirror image on the right side), one of the right wheel, and
//! a second patch of each. The instruction set is detected once. On processors with fused multiply-add, the last bits
//! of single precision differ from those on processors without.

use fearless_simd::{Simd, SimdBase, f64x4};

use super::forces::WheelsetForces;
use super::frame::Frame;
use super::lanes::{SIDES, TransposedOutput, located, ones};
use super::loaded_zones::LoadedZones;
use super::motion::{Motion, MotionNumbers, RailDisplacement, RailNumbers};
use super::source::{PatchReader, PatchSource};
use super::wheel::{MovingWheel, status};
use super::wheelset::WheelsetContact;
use super::wrench::Wrench;
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;
use crate::math::number::{Number, load};

#[inline(always)]
fn numbers<S: Simd>(simd: S, motion: &Motion) -> MotionNumbers<f64x4<S>> {
    let sides = load(simd, &SIDES);
    MotionNumbers::new(
        |field, _| simd.splat_f64x4(field(motion)),
        |field, _| simd.splat_f64x4(field(motion)) * sides,
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
