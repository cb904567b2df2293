//! Sources of the patches of a wheel: precomputed tables, or the geometry itself.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, f64x4};

use super::elastic::{ElasticPatch, Fineness, Gap, Given, NormalContact, TurnedStrips};
use super::geometry::ContactGeometry;
use super::motion::Tangent;
use super::patch_numbers::PatchNumbers;
use super::silhouette::WheelPose;
use super::zones::ZONES;

/// A source of the patches of a wheel.
///
/// [`Tables`](super::Tables) serve real time. [`ContactGeometry`] is slow, but without cells.
pub trait PatchSource: sealed::Source {}

impl<S: sealed::Source> PatchSource for S {}

pub(super) mod sealed {
    use fearless_simd::Simd;

    use super::{ContactGeometry, PatchReader, WheelPose};

    pub trait Source: Send + Sync + Sized {
        type Reader<'a>: PatchReader
        where
            Self: 'a;

        fn geometry(&self) -> &ContactGeometry;

        /// Finds the patches of a wheel whose tread datum is `depth_m` below the top of the rail.
        fn locate<S: Simd>(&self, simd: S, pose: &WheelPose, depth_m: f64) -> Self::Reader<'_>;
    }
}

/// Reads the patches of one wheel.
pub trait PatchReader {
    /// True if the source covers the pose.
    fn is_inside(&self) -> bool;

    /// The zones that carry load, as a bit mask.
    fn loaded_zones(&self) -> u32;

    /// Depth below the first touch, m.
    fn approach_m(&self) -> f64;

    /// Derivative of the load with respect to the depth, divided by the load, 1/m; zero without load.
    fn growth_per_m(&self) -> f64;

    /// The numbers of the patch of one zone.
    fn numbers(&self, zone: usize) -> PatchNumbers<f64>;

    /// The numbers of four patches: the lanes are left, right, left and right wheel, each with its zone.
    #[inline(always)]
    fn numbers_in_lanes<S: Simd>(
        simd: S,
        [left, right]: [&Self; 2],
        zones: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        Self::numbers_of_four(simd, [left, right, left, right], zones)
    }

    /// The numbers of the patches of four wheels, each with its zone.
    #[inline(always)]
    fn numbers_of_four<S: Simd>(
        simd: S,
        [first, second, third, fourth]: [&Self; 4],
        [a, b, c, d]: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        let lanes = [
            first.numbers(a).into_array(),
            second.numbers(b).into_array(),
            third.numbers(c).into_array(),
            fourth.numbers(d).into_array(),
        ];
        PatchNumbers::from_array(from_fn(|n| f64x4::from_fn(simd, |lane| lanes[lane][n])))
    }

    /// [`approach_m`](Self::approach_m) and the numbers of one zone, as functions of lateral shift, roll, yaw and
    /// depth.
    fn differentiated(
        &self,
        zone: usize,
        coordinates: [Tangent; 4],
    ) -> (Tangent, PatchNumbers<Tangent>);
}

/// The elastic contact of one wheel, computed from the geometry itself.
pub struct ComputedContact<'a> {
    geometry: &'a ContactGeometry,
    pose: WheelPose,
    depth_m: f64,
    solution: Solution,
}

/// Patches of a wheel, and its depth below the first touch.
struct Solution {
    approach_m: f64,
    patches: [ElasticPatch; ZONES],
}

/// Tolerance of the lengths of strips. The noise that it leaves is far below the differences that give derivatives.
const TOLERANCE: f64 = 1e-9;
/// Steps of the central differences: a micrometre, and a microradian, which is about a micrometre at the lever arm of a
/// wheelset; and a tenth of a micrometre of depth.
const STEPS: [f64; 4] = [1e-6, 1e-6, 1e-6, 1e-7];

/// Depth below the first touch, and the numbers of a patch.
type Values = (f64, [f64; 8]);

impl ContactGeometry {
    fn solution(&self, pose: &WheelPose, depth_m: f64) -> Solution {
        let wheel = TurnedStrips::new(self.pair(), pose.roll_rad, pose.yaw_rad, Fineness::Fine);
        let mut gap = Gap::default();
        gap.fill(&wheel, pose.lateral_m, |_| -depth_m);
        let mut contact = NormalContact::with_tolerance(TOLERANCE);
        contact.solve(&gap, self.steel(), Given::DepthM(depth_m));
        Solution {
            approach_m: depth_m + gap.highest_m,
            patches: self.patches_in(&gap, pose.lateral_m, &contact),
        }
    }
}

impl sealed::Source for ContactGeometry {
    type Reader<'a> = ComputedContact<'a>;

    fn geometry(&self) -> &ContactGeometry {
        self
    }

    fn locate<S: Simd>(&self, _: S, pose: &WheelPose, depth_m: f64) -> ComputedContact<'_> {
        ComputedContact {
            geometry: self,
            pose: *pose,
            depth_m,
            solution: self.solution(pose, depth_m),
        }
    }
}

impl ElasticPatch {
    fn to_numbers(self) -> PatchNumbers<f64> {
        PatchNumbers {
            load: self.load_n,
            whole_load: self.whole_load_n,
            sine: self.slope / libm::hypot(self.slope, 1.0),
            wheel_y: self.wheel_y_m,
            wheel_z: self.wheel_z_m,
            semi_axes: self.semi_axes_m,
            peak_pressure: self.peak_pressure_pa,
        }
    }
}

impl PatchReader for ComputedContact<'_> {
    fn is_inside(&self) -> bool {
        true
    }

    fn loaded_zones(&self) -> u32 {
        let patches = self.solution.patches.iter().enumerate();
        patches
            .map(|(zone, patch)| u32::from(patch.load_n > 0.0) << zone)
            .sum()
    }

    fn approach_m(&self) -> f64 {
        self.solution.approach_m
    }

    /// As in Hertz's contact.
    fn growth_per_m(&self) -> f64 {
        if self.solution.approach_m > 0.0 {
            1.5 / self.solution.approach_m
        } else {
            0.0
        }
    }

    fn numbers(&self, zone: usize) -> PatchNumbers<f64> {
        self.solution.patches[zone].to_numbers()
    }

    /// Central differences.
    fn differentiated(
        &self,
        zone: usize,
        coordinates: [Tangent; 4],
    ) -> (Tangent, PatchNumbers<Tangent>) {
        let of = |solution: &Solution| {
            let numbers = solution.patches[zone].to_numbers().into_array();
            (solution.approach_m, numbers)
        };
        let slopes: [Values; 4] = from_fn(|axis| {
            let at = |step: f64| {
                let (mut pose, mut depth_m) = (self.pose, self.depth_m);
                *[
                    &mut pose.lateral_m,
                    &mut pose.roll_rad,
                    &mut pose.yaw_rad,
                    &mut depth_m,
                ][axis] += step;
                of(&self.geometry.solution(&pose, depth_m))
            };
            let step = STEPS[axis];
            // Where the patch vanishes on one side, the difference to the other side counts.
            let here = of(&self.solution);
            let is_loaded = |end: &Values| end.1[0] > 0.0;
            let end = |step: f64| Some((at(step), step)).filter(|(end, _)| is_loaded(end));
            let ((before, from), (after, to)) = (
                end(-step).unwrap_or((here, 0.0)),
                end(step).unwrap_or((here, 0.0)),
            );
            let width = (to - from).max(step);
            let slope = |before: f64, after: f64| (after - before) / width;
            (
                slope(before.0, after.0),
                from_fn(|n| slope(before.1[n], after.1[n])),
            )
        });
        let function = |value: f64, slope: &dyn Fn(&Values) -> f64| {
            Tangent::function(
                value,
                from_fn::<_, 4, _>(|axis| (slope(&slopes[axis]), coordinates[axis])),
            )
        };
        let (approach_m, numbers) = of(&self.solution);
        (
            function(approach_m, &|slopes| slopes.0),
            PatchNumbers::from_array(from_fn(|n| function(numbers[n], &|slopes| slopes.1[n]))),
        )
    }
}
