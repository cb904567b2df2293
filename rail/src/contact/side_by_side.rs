//! The step: the patches of both wheels side by side in vector lanes.
//!
//! In the four lanes are a patch of the left wheel (of its mirror image on the right side), one of the right wheel, and
//! another of each. The instructions are those that the processor has, found out once; where these multiply and add without
//! rounding between, the last bits of single precision differ from those of a processor that cannot.

use fearless_simd::{Simd, dispatch, f64x4};

use super::forces::{PatchForces, TOLD, WheelsetForces};
use super::frame::Frame;
use super::loaded_zones::LoadedZones;
use super::motion::{MOTION_FIELDS, Motion, MotionNumbers, ODD, RailDisplacement, RailNumbers};
use super::source::{PatchReader, PatchSource};
use super::tables::LOAD_FRACTION;
use super::wheel::{Place, status};
use super::wheelset::WheelsetContact;
use crate::creep::CreepLaw;
use crate::math::each::Each;
use crate::math::number::{Lanes, Number, load, rows};

/// Sign of what is odd in a mirror about the track centre.
const SIDES: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];

#[inline(always)]
fn numbers<S: Simd>(simd: S, motion: &Motion) -> MotionNumbers<f64x4<S>> {
    let (values, sides) = (motion.numbers(), load(simd, &SIDES));
    let mut numbers = [sides; MOTION_FIELDS];
    for (field, number) in numbers.iter_mut().enumerate() {
        let lanes = simd.splat_f64x4(values[field]);
        *number = if ODD[field] { lanes * sides } else { lanes };
    }
    numbers
}

#[inline(always)]
fn rail_numbers<S: Simd>(simd: S, [left, right]: &[RailDisplacement; 2]) -> RailNumbers<f64x4<S>> {
    RailNumbers::new(
        |of| load(simd, &[of(left), of(right), of(left), of(right)]),
        |of| load(simd, &[-of(left), of(right), -of(left), of(right)]),
    )
}

/// What is told of the patch in each lane.
struct Told<S: Simd> {
    /// The first sixteen numbers in fours: of each four, those of each lane.
    fours: [[f64x4<S>; 4]; 4],
    last: f64x4<S>,
}

impl<S: Simd> Told<S> {
    #[inline(always)]
    fn new(told: [f64x4<S>; TOLD]) -> Self {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, last] = told;
        let i = i * load(i.simd, &SIDES);
        Self {
            fours: [
                rows([a, b, c, d]),
                rows([e, f, g, h]),
                rows([i, j, k, l]),
                rows([m, n, o, p]),
            ],
            last,
        }
    }

    #[inline(always)]
    fn write(&self, lane: usize, patch: &mut PatchForces) {
        let [first, second, third, fourth] = &self.fours;
        let [a, b, c, d] = first[lane].into();
        let [e, f, g, h] = second[lane].into();
        let [i, j, k, l] = third[lane].into();
        let [m, n, o, p] = fourth[lane].into();
        let last = self.last[lane];
        patch.set([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, last]);
    }
}

/// A bit for each lane whose number is greater than zero.
#[inline(always)]
fn above_zero<S: Simd>(numbers: f64x4<S>) -> u32 {
    let simd = numbers.simd;
    let above = simd.simd_gt_f64x4(numbers, simd.splat_f64x4(0.0));
    simd.to_bitmask_mask64x4(above) as u32
}

/// 1 in the lanes that are used, else 0: read from a table, which costs less than turning truths into numbers.
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

impl<L: CreepLaw, P: PatchSource> WheelsetContact<L, P> {
    /// [`WheelsetContact::update`] for `MANY` patches, or without a loop for at most two on a wheel; whether these were all.
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
        let place = Place::new(
            Frame::new(&numbers(simd, motion)),
            rail_numbers(simd, rails),
            self.lengths_in_lanes.map(|lengths| load(simd, lengths)),
        );
        let sources = [self.sources[0].as_ref(), self.sources[1].as_ref()];
        let [left_reader, right_reader] = P::locate_both(simd, &self.finder, sources, place.pose);
        let left_heights = left_reader.interpenetrations_m();
        let right_heights = right_reader.interpenetrations_m();
        let [left, right] = &mut forces.wheels;
        let loaded = [
            above_zero(load(simd, &left_heights) + place.depth[0]),
            above_zero(load(simd, &right_heights) + place.depth[1]),
        ];
        let mut left_zones = LoadedZones::new(loaded[0], left);
        let mut right_zones = LoadedZones::new(loaded[1], right);
        // Of both wheels.
        let mut wrench = [simd.splat_f64x2(0.0); 6];
        let mut penetration = simd.splat_f64x4(0.0);
        let mut wheel_y = simd.splat_f64x4(f64::MAX);
        while left_zones.are_left() | right_zones.are_left() {
            // A lane without a patch of its own computes the last one of its wheel again, with nothing of its load.
            let [(a, p), (b, q)] = [left_zones.advance(), right_zones.advance()];
            let [(c, r), (d, s)] = [left_zones.advance(), right_zones.advance()];
            if !MANY && (left_zones.are_left() | right_zones.are_left()) {
                return false;
            }
            let used = [p, q, r, s];
            let mut numbers =
                P::Reader::numbers_in_lanes(simd, [&left_reader, &right_reader], [a, b, c, d]);
            numbers[LOAD_FRACTION] *= load(simd, &ones(used));
            let heights = [
                left_heights[a],
                right_heights[b],
                left_heights[c],
                right_heights[d],
            ];
            let depth = (place.depth + load(simd, &heights)).not_negative();
            let patch = place.patch(&self.surface, depth, numbers, used);
            for (sum, term) in wrench.iter_mut().zip(patch.wrench) {
                let (first, again) = simd.split_f64x4(term);
                *sum += first + again;
            }
            penetration = penetration.at_least(patch.penetration);
            wheel_y = wheel_y.at_most(patch.wheel_y);
            let told = Told::new(patch.told);
            if p {
                told.write(0, &mut left.patches[a]);
            }
            if q {
                told.write(1, &mut right.patches[b]);
            }
            if r {
                told.write(2, &mut left.patches[c]);
            }
            if s {
                told.write(3, &mut right.patches[d]);
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
        forces.set_wrenches(wrench.each(|sum| sum.into()));
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
    use crate::contact::{ContactGeometry, Grid, Installation, Pair, Steel, Tables};
    use crate::creep::{Friction, KalkerBook};

    #[test]
    fn an_old_processor_computes_the_same_forces() {
        let pair = Pair::standard(Installation::default()).unwrap();
        let geometry = ContactGeometry::new(pair, Steel::default(), 100e3).unwrap();
        let mut grid = Grid::default();
        grid.roll_rad.cells = [1, 2, 1];
        grid.yaw_squared_rad2.cells = [0, 1, 1];
        let tables = Arc::new(Tables::new(geometry, grid).unwrap());
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
