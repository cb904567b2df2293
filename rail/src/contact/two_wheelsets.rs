//! Contact of two wheelsets that share their tables: one wheel in each vector lane.

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

/// Patches of a wheel up to which their forces add up in the same order as in
/// [`update`](WheelsetContact::update), where two patches of a wheel are evaluated at a time.
const MAX_PATCHES: u32 = 3;

#[inline(always)]
fn numbers<S: Simd>(simd: S, [a, b]: &[Motion; 2]) -> MotionNumbers<f64x4<S>> {
    let sides = load(simd, &SIDES);
    let both = |field: fn(&Motion) -> f64| load(simd, &[field(a), field(a), field(b), field(b)]);
    MotionNumbers::new(|field, _| both(field), |field, _| both(field) * sides)
}

#[inline(always)]
fn rail_numbers<S: Simd>(
    simd: S,
    [[a, b], [c, d]]: &[[RailDisplacement; 2]; 2],
) -> RailNumbers<f64x4<S>> {
    let sides = load(simd, &SIDES);
    let four =
        |field: fn(&RailDisplacement) -> f64| load(simd, &[field(a), field(b), field(c), field(d)]);
    RailNumbers::new(four, |field| four(field) * sides)
}

impl<L: CreepLaw, P: PatchSource> WheelsetContact<L, P> {
    /// Updates the forces of two wheelsets. They have the same bits as those of [`update`](WheelsetContact::update) of
    /// each.
    #[inline]
    pub(crate) fn update_two(
        &self,
        motions: &[Motion; 2],
        rails: &[[RailDisplacement; 2]; 2],
        mut forces: [&mut WheelsetForces; 2],
    ) {
        let is_done = dispatch!(self.level, simd => {
            self.update_two_in(simd, motions, rails, &mut forces)
        });
        if !is_done {
            for (number, forces) in forces.into_iter().enumerate() {
                self.update(&motions[number], &rails[number], forces);
            }
        }
    }

    /// Returns false for motions that are rare: those that are not accepted, rolling in opposite directions, or with
    /// many patches on a wheel.
    #[inline(always)]
    fn update_two_in<S: Simd>(
        &self,
        simd: S,
        motions: &[Motion; 2],
        rails: &[[RailDisplacement; 2]; 2],
        forces: &mut [&mut WheelsetForces; 2],
    ) -> bool {
        let is_backward = motions.each_ref().map(|motion| motion.speed_m_per_s < 0.0);
        let [first, second] = forces;
        let are_accepted =
            first.begin(&motions[0], &rails[0]) & second.begin(&motions[1], &rails[1]);
        if !are_accepted | (is_backward[0] != is_backward[1]) {
            return false;
        }
        let on_rails = rail_numbers(simd, rails);
        let moving = MovingWheel::new(
            Frame::new(&numbers(simd, motions), &on_rails),
            on_rails,
            self.lengths_in_lanes.map(|lengths| load(simd, lengths)),
        );
        let sources = [self.sources[0].as_ref(), self.sources[1].as_ref()];
        let readers = [
            &located(simd, sources[0], &moving, 0),
            &located(simd, sources[1], &moving, 1),
            &located(simd, sources[0], &moving, 2),
            &located(simd, sources[1], &moving, 3),
        ];
        let [a, b, c, d] = readers;
        let loaded = [
            a.loaded_zones(),
            b.loaded_zones(),
            c.loaded_zones(),
            d.loaded_zones(),
        ];
        if loaded.iter().any(|zones| zones.count_ones() > MAX_PATCHES) {
            return false;
        }
        let approach = [
            a.approach_m(),
            b.approach_m(),
            c.approach_m(),
            d.approach_m(),
        ];
        let approach = load(simd, &approach).not_negative();
        let growth = [
            a.growth_per_m(),
            b.growth_per_m(),
            c.growth_per_m(),
            d.growth_per_m(),
        ];
        let growth = load(simd, &growth);
        let [p, q] = &mut first.wheels;
        let [r, s] = &mut second.wheels;
        let mut zones = [
            LoadedZones::new(loaded[0], p),
            LoadedZones::new(loaded[1], q),
            LoadedZones::new(loaded[2], r),
            LoadedZones::new(loaded[3], s),
        ];
        let mut wrench = Wrench::splat(simd.splat_f64x4(0.0));
        let mut penetration = simd.splat_f64x4(0.0);
        let mut wheel_y = simd.splat_f64x4(f64::MAX);
        while zones[0].are_left() | zones[1].are_left() | zones[2].are_left() | zones[3].are_left()
        {
            // A lane without a patch repeats the wheel's last patch with zero load.
            let [(a, is_a), (b, is_b), (c, is_c), (d, is_d)] = [
                zones[0].advance(),
                zones[1].advance(),
                zones[2].advance(),
                zones[3].advance(),
            ];
            let used = [is_a, is_b, is_c, is_d];
            let mut numbers = P::Reader::numbers_of_four(simd, readers, [a, b, c, d]);
            numbers.load *= load(simd, &ones(used));
            let patch = moving.patch(&self.surface, [approach, growth], numbers, used);
            wrench.accumulate(&patch.wrench, |sum, term| sum + term);
            penetration = penetration.max(patch.output.penetration);
            wheel_y = wheel_y.min(patch.output.wheel_y);
            let output = TransposedOutput::new(patch.output);
            if is_a {
                output.write(0, &mut p.patches[a]);
            }
            if is_b {
                output.write(1, &mut q.patches[b]);
            }
            if is_c {
                output.write(2, &mut r.patches[c]);
            }
            if is_d {
                output.write(3, &mut s.patches[d]);
            }
        }
        let inside = [a.is_inside(), b.is_inside(), c.is_inside(), d.is_inside()];
        for (lane, wheel) in [p, q, r, s].into_iter().enumerate() {
            wheel.status = status(
                sources[lane % 2].geometry().pair(),
                inside[lane],
                loaded[lane] != 0,
                penetration[lane],
                wheel_y[lane],
            );
        }
        let wrench = wrench.map(<[f64; 4]>::from);
        first.set_wrenches(wrench.map(|[left, right, ..]| [left, right]));
        second.set_wrenches(wrench.map(|[.., left, right]| [left, right]));
        true
    }
}

#[cfg(test)]
mod tests;
