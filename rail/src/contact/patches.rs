//! Where a wheel touches its rail: the contact patch of the tread and that of the flange.

use super::pair::Pair;
use super::silhouette::{SilhouettePoint, WheelPose};

/// Regularization length of the contact search, m: about a tenth of the penetration under a
/// wheel load. A greater one blends tread and flange, with a smaller one the contact jumps.
pub const REGULARIZATION_M: f64 = 1e-5;

/// One contact patch of a wheel, on the tread or on the flange, at the greatest interpenetration there.
///
/// Every quantity is a mean over the silhouette with weights `exp(interpenetration / regularization)`, so that it
/// moves continuously where the contact of rigid bodies would jump (quasi-elastic contact, Arnold and Netter 1998).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Patch {
    /// Depth of the wheel below the rail's surface when the tread datum is at the height of the rail's top, m.
    pub interpenetration_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Depth on the wheel, m: the rolling radius is the wheel radius plus this.
    pub wheel_z_m: f64,
    /// Lateral position from the track centre, m.
    pub track_y_m: f64,
    /// `dz/dy` of both surfaces across the track: the tangent of the contact angle.
    pub slope: f64,
    /// Curvature of the rail less that of the wheel across the track, 1/m.
    pub curvature_per_m: f64,
    /// Fraction of the load that the patch carries, 0 to 1: below 1 where tread and flange are still one patch.
    pub load_fraction: f64,
}

/// The patches of one wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Patches {
    /// The patch on the tread.
    pub tread: Patch,
    /// The patch on the flange and its root.
    pub flange: Patch,
}

/// Depth of the valley between tread and flange from which they are two patches, in regularization lengths.
const SEPARATION: f64 = 4.0;

/// Interpenetration of a part of the wheel that is nowhere over the rail, m: far above it.
const ABSENT_M: f64 = -0.05;

impl Pair {
    /// The patches of tread and flange at `pose`; `scratch` is working memory that is overwritten.
    ///
    /// While no valley in the interpenetration separates the patches they divide one load in proportion to
    /// their weights; once the valley is four times `regularization_m` deep, each carries its own load. The
    /// position of the boundary between tread and flange has no influence on the sum.
    pub fn patches(
        &self,
        pose: &WheelPose,
        regularization_m: f64,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> Patches {
        self.silhouette(pose, scratch);
        let boundary = scratch
            .iter()
            .position(|p| self.wheel().points()[p.index].y_m > self.tread_end_m())
            .unwrap_or(scratch.len());
        let (flange_part, tread_part) = scratch.split_at(boundary);
        let greatest = |part: &[SilhouettePoint]| {
            let depths = part.iter().map(|p| p.interpenetration_m);
            depths.fold(f64::MIN, f64::max)
        };
        let peaks = [greatest(tread_part), greatest(flange_part)];
        let top = peaks[0].max(peaks[1]);
        let (tread_weight, mut tread) = self.mean(tread_part, peaks[0], regularization_m);
        let (flange_weight, mut flange) = self.mean(flange_part, peaks[1], regularization_m);
        let at = |part: &[SilhouettePoint], peak: f64| {
            part.iter().position(|p| p.interpenetration_m == peak)
        };
        let valley_depth = match (at(flange_part, peaks[1]), at(tread_part, peaks[0])) {
            (Some(i), Some(j)) => {
                let valley = scratch[i..=boundary + j]
                    .iter()
                    .map(|p| p.interpenetration_m);
                peaks[0].min(peaks[1]) - valley.fold(f64::MAX, f64::min)
            }
            _ => f64::MAX,
        };
        let t = (valley_depth / (SEPARATION * regularization_m)).min(1.0);
        let separate = t * t * (3.0 - 2.0 * t);
        let weights = [
            tread_weight * ((peaks[0] - top) / regularization_m).exp(),
            flange_weight * ((peaks[1] - top) / regularization_m).exp(),
        ];
        let total = (weights[0] + weights[1]).max(f64::MIN_POSITIVE);
        tread.load_fraction = separate + (1.0 - separate) * weights[0] / total;
        flange.load_fraction = separate + (1.0 - separate) * weights[1] / total;
        Patches { tread, flange }
    }

    /// Sum of the weights over `part`, relative to its greatest interpenetration `peak`, and the weighted means.
    fn mean(&self, part: &[SilhouettePoint], peak: f64, regularization: f64) -> (f64, Patch) {
        let mut total = 0.0;
        let mut sum = [0.0; 6];
        for (i, point) in part.iter().enumerate() {
            let exponent = (point.interpenetration_m - peak) / regularization;
            if exponent < -40.0 {
                continue;
            }
            let next = part.get(i + 1).unwrap_or(point).track_y_m;
            let previous = part[i.saturating_sub(1)].track_y_m;
            let weight = exponent.exp() * 0.5 * (next - previous).abs();
            total += weight;
            for (sum, term) in sum.iter_mut().zip(self.quantities(point)) {
                *sum += weight * term;
            }
        }
        if total <= 0.0 {
            return (0.0, self.absent());
        }
        let mut patch = Patch::from_quantities(sum.map(|sum| sum / total));
        // The mean over a parabola lies half a regularization length below its vertex.
        patch.interpenetration_m += 0.5 * regularization;
        (total, patch)
    }

    /// The patch of a part of the wheel that is nowhere over the rail.
    pub(super) fn absent(&self) -> Patch {
        Patch {
            interpenetration_m: ABSENT_M,
            wheel_y_m: self.tread_end_m(),
            wheel_z_m: 0.0,
            track_y_m: self.installation().datum_offset_m(),
            slope: 0.0,
            curvature_per_m: 1.0,
            load_fraction: 0.0,
        }
    }

    /// The quantities of a patch at one point, in the order of [`Patch::from_quantities`].
    pub(super) fn quantities(&self, point: &SilhouettePoint) -> [f64; 6] {
        let on_wheel = &self.wheel().points()[point.index];
        [
            point.interpenetration_m,
            on_wheel.y_m,
            on_wheel.z_m,
            point.track_y_m,
            point.slope,
            point.curvature_per_m,
        ]
    }
}

impl Patch {
    /// The patch of these quantities, carrying the whole load.
    pub(super) fn from_quantities(quantities: [f64; 6]) -> Self {
        let [
            interpenetration_m,
            wheel_y_m,
            wheel_z_m,
            track_y_m,
            slope,
            curvature_per_m,
        ] = quantities;
        Self {
            interpenetration_m,
            wheel_y_m,
            wheel_z_m,
            track_y_m,
            slope,
            curvature_per_m,
            load_fraction: 1.0,
        }
    }
}
