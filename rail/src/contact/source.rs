//! Where the step takes the patches of a pose from: tables, or the geometry itself.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, f64x4};

use super::geometry::ContactGeometry;
use super::motion::Tangent;
use super::silhouette::WheelPose;
use super::tables::{NUMBERS, TabulatedPatch};
use super::zones::ZONES;
use crate::math::number::Number;

/// A source of the patches of a wheel: [`Tables`](super::Tables) in real time, [`ContactGeometry`] where
/// time does not matter and every number is to be smooth and in double precision.
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

        /// What finds the poses of a left and a right wheel.
        type Finder: Clone + Debug + Send + Sync;

        fn geometry(&self) -> &ContactGeometry;

        /// The place of `pose` in the source.
        fn locate(&self, pose: &WheelPose) -> Self::Reader<'_>;

        /// The finder of a left and a right wheel.
        fn finder(sides: [&Self; 2]) -> Self::Finder;

        /// The places of the poses (lateral shift, roll, yaw) in the first two lanes, each in its own source.
        fn locate_both<'a, S: Simd>(
            simd: S,
            finder: &Self::Finder,
            sides: [&'a Self; 2],
            pose: [f64x4<S>; 3],
        ) -> [Self::Reader<'a>; 2];
    }
}

/// The patches of one pose, read one by one.
pub trait PatchReader {
    /// Whether the pose is one of those that the source covers.
    fn is_inside(&self) -> bool;

    /// Interpenetration of each patch, m.
    fn interpenetrations_m(&self) -> [f64; ZONES];

    /// The numbers of one patch, as [`TabulatedPatch::to_numbers`].
    fn numbers(&self, zone: usize) -> [f64; NUMBERS];

    /// The numbers of the patches in four lanes, of the left and the right wheel and again of both.
    #[inline(always)]
    fn numbers_in_lanes<S: Simd>(
        simd: S,
        [left, right]: [&Self; 2],
        [a, b, c, d]: [usize; 4],
    ) -> [f64x4<S>; NUMBERS] {
        let lanes = [
            left.numbers(a),
            right.numbers(b),
            left.numbers(c),
            right.numbers(d),
        ];
        from_fn(|n| f64x4::from_fn(simd, |lane| lanes[lane][n]))
    }

    /// Derivatives of interpenetration and numbers of one patch by lateral shift, roll and yaw.
    fn slopes(&self, zone: usize) -> [Slopes; 3];
}

/// The derivative of the interpenetration of a patch, then those of its numbers.
pub type Slopes = [f64; 1 + NUMBERS];

/// Interpenetration and numbers of one patch as functions of `pose` (lateral shift, roll, yaw).
#[inline(always)]
pub(super) fn functions_of_pose<R: PatchReader>(
    reader: &R,
    zone: usize,
    interpenetration: f64,
    pose: [Tangent; 3],
) -> (Tangent, [Tangent; NUMBERS]) {
    let (numbers, slopes) = (reader.numbers(zone), reader.slopes(zone));
    let function = |value: f64, n: usize| {
        Tangent::function(
            value,
            from_fn::<_, 3, _>(|axis| (slopes[axis][n], pose[axis])),
        )
    };
    (
        function(interpenetration, 0),
        from_fn(|n| function(numbers[n], 1 + n)),
    )
}

/// The numbers of a patch behind its interpenetration, in the order of [`Slopes`].
#[inline(always)]
pub(super) fn with_interpenetration(interpenetration: f64, numbers: [f64; NUMBERS]) -> Slopes {
    from_fn(|n| {
        if n == 0 {
            interpenetration
        } else {
            numbers[n - 1]
        }
    })
}

/// A pose of the geometry itself.
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

    fn numbers(&self, zone: usize) -> [f64; NUMBERS] {
        self.patches[zone].to_numbers()
    }

    /// Central differences.
    fn slopes(&self, zone: usize) -> [Slopes; 3] {
        let mut scratch = Vec::new();
        from_fn(|axis| {
            let mut at = |step: f64| {
                let mut pose = self.pose;
                *[&mut pose.lateral_m, &mut pose.roll_rad, &mut pose.yaw_rad][axis] += step;
                let patch = self.geometry.patches(&pose, &mut scratch)[zone];
                with_interpenetration(patch.interpenetration_m, patch.to_numbers())
            };
            // A micrometre, or a microradian at the arm of a metre.
            let step = 1e-6;
            let (before, after) = (at(-step), at(step));
            from_fn(|n| (after[n] - before[n]) / (2.0 * step))
        })
    }
}
