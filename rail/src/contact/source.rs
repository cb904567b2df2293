//! Sources of the patches of a pose: precomputed tables, or the geometry itself.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, f64x4};

use super::geometry::ContactGeometry;
use super::motion::Tangent;
use super::silhouette::WheelPose;
use super::tabulated_patch::{NUMBERS, PatchNumbers, TabulatedPatch};
use super::zones::ZONES;
use crate::math::number::Number;

/// A source of the patches of a wheel.
///
/// [`Tables`](super::Tables) serve real time. [`ContactGeometry`] is slow, but smooth and in double precision.
pub trait PatchSource: sealed::Source {}

impl<S: sealed::Source> PatchSource for S {}

pub(super) mod sealed {
    use std::fmt::Debug;

    use fearless_simd::{Simd, f64x4};

    use super::{ContactGeometry, PatchReader, WheelPose};

    pub trait Source: Send + Sync + Sized {
        type Reader<'a>: PatchReader
        where
            Self: 'a;

        /// Locates the poses of a left and a right wheel.
        type Finder: Clone + Debug + Send + Sync;

        fn geometry(&self) -> &ContactGeometry;

        /// Locates `pose` in the source.
        fn locate(&self, pose: &WheelPose) -> Self::Reader<'_>;

        /// Builds the finder of a left and a right wheel.
        fn finder(sides: [&Self; 2]) -> Self::Finder;

        /// Locates the poses (lateral shift, roll, yaw) of the first two lanes, each in its own source.
        fn locate_both<'a, S: Simd>(
            simd: S,
            finder: &Self::Finder,
            sides: [&'a Self; 2],
            pose: [f64x4<S>; 3],
        ) -> [Self::Reader<'a>; 2];
    }
}

/// Reads the patches of one pose.
pub trait PatchReader {
    /// True if the source covers the pose.
    fn is_inside(&self) -> bool;

    /// Interpenetration of each patch, m.
    fn interpenetrations_m(&self) -> [f64; ZONES];

    /// The numbers of one patch.
    fn numbers(&self, zone: usize) -> PatchNumbers<f64>;

    /// The numbers of four patches: the lanes are left, right, left and right wheel, each with its zone.
    #[inline(always)]
    fn numbers_in_lanes<S: Simd>(
        simd: S,
        [left, right]: [&Self; 2],
        [a, b, c, d]: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        let lanes = [
            left.numbers(a).to_array(),
            right.numbers(b).to_array(),
            left.numbers(c).to_array(),
            right.numbers(d).to_array(),
        ];
        PatchNumbers::from_array(from_fn(|n| f64x4::from_fn(simd, |lane| lanes[lane][n])))
    }

    /// Derivatives of one patch with respect to lateral shift, roll and yaw.
    fn slopes(&self, zone: usize) -> [PatchSlopes; 3];
}

/// Derivatives of a patch with respect to one coordinate of the pose.
pub struct PatchSlopes {
    pub interpenetration: f64,
    pub numbers: PatchNumbers<f64>,
}

/// Interpenetration and numbers of one patch, differentiated with respect to `pose` (lateral shift, roll, yaw).
#[inline(always)]
pub(super) fn differentiated<R: PatchReader>(
    reader: &R,
    zone: usize,
    interpenetration: f64,
    pose: [Tangent; 3],
) -> (Tangent, PatchNumbers<Tangent>) {
    let (numbers, slopes) = (reader.numbers(zone).to_array(), reader.slopes(zone));
    let function = |value: f64, slopes: [f64; 3]| {
        Tangent::function(value, [0, 1, 2].map(|axis| (slopes[axis], pose[axis])))
    };
    let of_depth = slopes.each_ref().map(|slopes| slopes.interpenetration);
    let of_numbers = slopes.map(|slopes| slopes.numbers.to_array());
    (
        function(interpenetration, of_depth),
        PatchNumbers::from_array(from_fn::<_, NUMBERS, _>(|n| {
            function(numbers[n], of_numbers.map(|slopes| slopes[n]))
        })),
    )
}

/// A pose evaluated from the geometry itself.
pub struct ComputedPose<'a> {
    geometry: &'a ContactGeometry,
    pose: WheelPose,
    patches: [TabulatedPatch; ZONES],
}

impl sealed::Source for ContactGeometry {
    type Reader<'a> = ComputedPose<'a>;
    type Finder = ();

    fn geometry(&self) -> &ContactGeometry {
        self
    }

    fn locate(&self, pose: &WheelPose) -> ComputedPose<'_> {
        ComputedPose {
            geometry: self,
            pose: *pose,
            patches: self.patches(pose, &mut Vec::new()),
        }
    }

    fn finder(_: [&Self; 2]) {}

    fn locate_both<'a, S: Simd>(
        _: S,
        (): &(),
        [left, right]: [&'a Self; 2],
        pose: [f64x4<S>; 3],
    ) -> [ComputedPose<'a>; 2] {
        let in_lane = |lane: usize| {
            let [lateral_m, roll_rad, yaw_rad] = pose.map(|number| number.lane(lane));
            WheelPose {
                lateral_m,
                roll_rad,
                yaw_rad,
            }
        };
        [left.locate(&in_lane(0)), right.locate(&in_lane(1))]
    }
}

impl PatchReader for ComputedPose<'_> {
    fn is_inside(&self) -> bool {
        true
    }

    fn interpenetrations_m(&self) -> [f64; ZONES] {
        self.patches.map(|patch| patch.interpenetration_m)
    }

    fn numbers(&self, zone: usize) -> PatchNumbers<f64> {
        self.patches[zone].to_numbers()
    }

    /// Central differences.
    fn slopes(&self, zone: usize) -> [PatchSlopes; 3] {
        let mut scratch = Vec::new();
        from_fn(|axis| {
            let mut at = |step: f64| {
                let mut pose = self.pose;
                *[&mut pose.lateral_m, &mut pose.roll_rad, &mut pose.yaw_rad][axis] += step;
                self.geometry.patches(&pose, &mut scratch)[zone]
            };
            // A micrometre, or a microradian, which is about a micrometre at the lever arm of a wheelset.
            let step = 1e-6;
            let (before, after) = (at(-step), at(step));
            let slope = |before: f64, after: f64| (after - before) / (2.0 * step);
            let [from, to] = [before, after].map(|patch| patch.to_numbers().to_array());
            PatchSlopes {
                interpenetration: slope(before.interpenetration_m, after.interpenetration_m),
                numbers: PatchNumbers::from_array(from_fn(|n| slope(from[n], to[n]))),
            }
        })
    }
}
