//! Where the step takes the patches of a pose from: tables, or the geometry itself.

use std::array::from_fn;

use super::geometry::ContactGeometry;
use super::motion::Tangent;
use super::silhouette::WheelPose;
use super::tables::{NUMBERS, TabulatedPatch};
use super::zones::ZONES;

/// A source of the patches of a wheel: [`Tables`](super::Tables) in real time, [`ContactGeometry`] where
/// time does not matter and every number is to be smooth and in double precision.
pub trait PatchSource: sealed::Source {}

impl<S: sealed::Source> PatchSource for S {}

pub(super) mod sealed {
    use super::{ContactGeometry, PatchReader, WheelPose};

    pub trait Source: Send + Sync {
        type Reader<'a>: PatchReader
        where
            Self: 'a;

        fn geometry(&self) -> &ContactGeometry;

        /// The place of `pose` in the source.
        fn locate(&self, pose: &WheelPose) -> Self::Reader<'_>;
    }
}

/// The patches of one pose, read one by one.
pub trait PatchReader {
    /// Whether the pose is one of those that the source covers.
    fn is_inside(&self) -> bool;

    /// Interpenetration of each patch, m.
    fn interpenetrations_m(&self) -> [f64; ZONES];

    /// Derivatives of the interpenetration of one patch by lateral shift, roll and yaw.
    fn interpenetration_slopes(&self, zone: usize) -> [f64; 3];

    /// The numbers of one patch, as [`TabulatedPatch::to_numbers`].
    fn numbers(&self, zone: usize) -> [f64; NUMBERS];

    /// Their derivatives by lateral shift, roll and yaw.
    fn number_slopes(&self, zone: usize) -> [[f64; NUMBERS]; 3];
}

/// Interpenetration and numbers of one patch as functions of `pose` (lateral shift, roll, yaw).
#[inline(always)]
pub(super) fn functions_of_pose<R: PatchReader>(
    reader: &R,
    zone: usize,
    interpenetration: f64,
    pose: [Tangent; 3],
) -> (Tangent, [Tangent; NUMBERS]) {
    let function = |value: f64, slopes: [f64; 3]| {
        Tangent::function(value, from_fn::<_, 3, _>(|axis| (slopes[axis], pose[axis])))
    };
    let (numbers, slopes) = (reader.numbers(zone), reader.number_slopes(zone));
    (
        function(interpenetration, reader.interpenetration_slopes(zone)),
        from_fn(|n| function(numbers[n], slopes.map(|slopes| slopes[n]))),
    )
}

/// A pose of the geometry itself.
pub struct ComputedPose<'a> {
    geometry: &'a ContactGeometry,
    pose: WheelPose,
    patches: [TabulatedPatch; ZONES],
}

impl sealed::Source for ContactGeometry {
    type Reader<'a> = ComputedPose<'a>;

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
}

impl ComputedPose<'_> {
    /// Central differences of what `read` takes from a patch, by lateral shift, roll and yaw.
    fn differences<const N: usize>(
        &self,
        zone: usize,
        read: impl Fn(&TabulatedPatch) -> [f64; N],
    ) -> [[f64; N]; 3] {
        let mut scratch = Vec::new();
        from_fn(|axis| {
            let mut at = |step: f64| {
                let mut pose = self.pose;
                *[&mut pose.lateral_m, &mut pose.roll_rad, &mut pose.yaw_rad][axis] += step;
                read(&self.geometry.patches(&pose, &mut scratch)[zone])
            };
            // A micrometre, or a microradian at the arm of a metre.
            let step = 1e-6;
            let (before, after) = (at(-step), at(step));
            from_fn(|n| (after[n] - before[n]) / (2.0 * step))
        })
    }
}

impl PatchReader for ComputedPose<'_> {
    fn is_inside(&self) -> bool {
        true
    }

    fn interpenetrations_m(&self) -> [f64; ZONES] {
        self.patches.map(|patch| patch.interpenetration_m)
    }

    fn interpenetration_slopes(&self, zone: usize) -> [f64; 3] {
        self.differences(zone, |patch| [patch.interpenetration_m])
            .map(|[slope]| slope)
    }

    fn numbers(&self, zone: usize) -> [f64; NUMBERS] {
        self.patches[zone].to_numbers()
    }

    fn number_slopes(&self, zone: usize) -> [[f64; NUMBERS]; 3] {
        self.differences(zone, |patch| patch.to_numbers())
    }
}
