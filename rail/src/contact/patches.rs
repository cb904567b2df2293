//! Contact patches of a wheel: one at the summit of each zone.

use std::ops::Range;

use super::hertz::{Hertz, Steel};
use super::pair::Pair;
use super::silhouette::{SilhouettePoint, TurnedWheel};
use super::zones::{ZONES, Zones};

/// Softness of the contact divided by the Hertzian penetration.
///
/// With 0.25 the contact position agrees with that of an elastic half-space within 0.15 mm; 0.26 also halves the
/// remaining error of the steering forces near the centre.
const SOFTNESS_RATIO: f64 = 0.26;
/// Transverse curvature of the contact whose penetration sets the softness, 1/m: a rail head of R 300.
const TYPICAL_CURVATURE_PER_M: f64 = 1.0 / 0.3;

/// Softness of the contact of a wheel of `wheel_radius_m` under `load_n`, m: the interpenetration over which the weight
/// of a point falls to `1/e`. It is 0.26 times the Hertzian penetration on a rail head of R 300.
///
/// ```
/// use dashpot_rail::contact::{Steel, softness_m};
/// let at_100_kn = softness_m(&Steel::default(), 0.625, 100e3);
/// assert!((at_100_kn - 25.6e-6).abs() < 0.1e-6);
/// ```
pub fn softness_m(steel: &Steel, wheel_radius_m: f64, load_n: f64) -> f64 {
    let typical = Hertz::new(steel, 1.0 / wheel_radius_m, TYPICAL_CURVATURE_PER_M);
    SOFTNESS_RATIO * typical.penetration_m(load_n)
}

/// One contact patch of a wheel.
///
/// Each quantity is a mean over the silhouette of the zone with weights `exp(normal height / softness)`, so it moves
/// continuously where the contact of rigid bodies would jump (quasi-elastic contact, Arnold and Netter 1998).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Patch {
    /// Depth of the wheel below the rail's surface when the tread datum is at the height of the rail's top, m.
    pub interpenetration_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Depth on the wheel, m; the rolling radius is the wheel radius plus this depth.
    pub wheel_z_m: f64,
    /// Lateral position from the track centre, m.
    pub track_y_m: f64,
    /// `dz/dy` of both surfaces across the track: the tangent of the contact angle.
    pub slope: f64,
    /// Curvature of the rail minus that of the wheel, across the track, 1/m.
    pub curvature_per_m: f64,
    /// Fraction of the load at `interpenetration_m` and `curvature_per_m` that the patch carries, 0 to 1; below 1 if no
    /// valley separates the patch from a neighbour.
    pub load_fraction: f64,
}

/// Valley depth at which two patches are fully separate, in multiples of the softness.
const SEPARATION: f64 = 4.0;
/// Interpenetration of a zone that is nowhere over the rail, m. It lies far out of contact.
const ABSENT_M: f64 = -0.05;
/// Points whose weight is below `exp(MIN_EXPONENT)` are neglected.
const MIN_EXPONENT: f64 = -20.0;

impl TurnedWheel<'_> {
    /// Computes the patch of each zone at a lateral shift, from the flange to the field side. `scratch` is working
    /// memory and is overwritten.
    ///
    /// Two summits with a valley of depth `v` between them are merged to the degree `1 - S(v / (4 * softness))`, where
    /// `S` is the smooth step. A fully separate patch carries its own load at its own interpenetration and curvature.
    /// Merged patches share one load; its interpenetration and curvature are weighted means over all of them. Sums over
    /// a wheel are therefore continuous where a summit splits or two summits merge.
    pub fn patches(
        &self,
        lateral_m: f64,
        zones: &Zones,
        softness_m: f64,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> [Patch; ZONES] {
        self.silhouette(lateral_m, scratch);
        let ends = zones.ends_m(lateral_m);
        let summits: [Option<Summit>; ZONES] = std::array::from_fn(|zone| {
            let start = if zone == 0 { f64::MIN } else { ends[zone - 1] };
            let end = ends.get(zone).copied().unwrap_or(f64::MAX);
            self.summit(scratch, start..end, softness_m)
        });
        std::array::from_fn(|zone| {
            let Some(own) = &summits[zone] else {
                return self.pair().absent();
            };
            // Degree to which each summit is merged with this one.
            let merged = summits.each_ref().map(|other| {
                let Some(other) = other else {
                    return 0.0;
                };
                let between = own.sample.min(other.sample)..=own.sample.max(other.sample);
                let lowest = scratch[between]
                    .iter()
                    .map(|p| p.normal_height_m)
                    .fold(f64::MAX, f64::min);
                let valley_m = own.height_m.min(other.height_m) - lowest;
                let t = (valley_m / (SEPARATION * softness_m)).clamp(0.0, 1.0);
                1.0 - t * t * (3.0 - 2.0 * t)
            });
            let group = || {
                let pairs = summits.iter().zip(merged);
                pairs
                    .filter_map(|(other, merged)| Some((other.as_ref()?, merged)))
                    .filter(|(_, merged)| *merged > 0.0)
            };
            let highest = group().fold(own.height_m, |highest, (other, _)| {
                highest.max(other.height_m)
            });
            let weight = |summit: &Summit| {
                summit.weight_m * ((summit.height_m - highest) / softness_m).exp()
            };
            let mut total = 0.0;
            let (mut interpenetration, mut curvature) = (0.0, 0.0);
            for (other, merged) in group() {
                let weight = merged * weight(other);
                total += weight;
                interpenetration += weight * other.patch.interpenetration_m;
                curvature += weight * other.patch.curvature_per_m;
            }
            Patch {
                interpenetration_m: interpenetration / total,
                curvature_per_m: curvature / total,
                load_fraction: weight(own) / total,
                ..own.patch
            }
        })
    }

    /// Finds the summit of the wheel within `zone` (m from the tread datum); `None` if the zone is nowhere over the
    /// rail.
    fn summit(
        &self,
        silhouette: &[SilhouettePoint],
        zone: Range<f64>,
        softness: f64,
    ) -> Option<Summit> {
        // A sample represents the stretch of the wheel that reaches halfway to each of its neighbours, as far as this
        // stretch lies within the zone.
        let points = self.pair().wheel().points();
        let middle = |i: usize, j: usize| 0.5 * (points[i].y_m + points[j].y_m);
        let left = |i: usize| middle(i.saturating_sub(1), i);
        let right = |i: usize| middle(i, (i + 1).min(points.len() - 1));
        let first = silhouette.partition_point(|p| right(p.index) <= zone.start);
        let end = silhouette.partition_point(|p| left(p.index) < zone.end);
        let height = |i: usize| silhouette[i].normal_height_m;
        let sample = (first..end).max_by(|&i, &j| height(i).total_cmp(&height(j)))?;
        let mut weight_m = 0.0;
        let mut sum = Patch::uniform(0.0);
        for point in &silhouette[first..end] {
            let exponent = (point.normal_height_m - height(sample)) / softness;
            if exponent < MIN_EXPONENT {
                continue;
            }
            let width = right(point.index).min(zone.end) - left(point.index).max(zone.start);
            let weight = exponent.exp() * width;
            weight_m += weight;
            let here = self.pair().patch_at(point);
            sum = sum.zip(&here, |sum, term| sum + weight * term);
        }
        if weight_m <= 0.0 {
            return None;
        }
        let mut patch = sum.zip(&sum, |sum, _| sum / weight_m);
        // The mean over a parabola lies below its vertex by half the softness, along the normal.
        patch.interpenetration_m += 0.5 * softness * 1.0_f64.hypot(patch.slope);
        Some(Summit {
            sample,
            height_m: height(sample),
            weight_m,
            patch,
        })
    }
}

impl Pair {
    /// The patch of a zone that is nowhere over the rail.
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

    /// The patch at one point of the silhouette, carrying the whole load.
    pub(super) fn patch_at(&self, point: &SilhouettePoint) -> Patch {
        let on_wheel = &self.wheel().points()[point.index];
        Patch {
            interpenetration_m: point.interpenetration_m,
            wheel_y_m: on_wheel.y_m,
            wheel_z_m: on_wheel.z_m,
            track_y_m: point.track_y_m,
            slope: point.slope,
            curvature_per_m: point.curvature_per_m,
            load_fraction: 1.0,
        }
    }
}

/// The point of one zone with the largest normal height.
struct Summit {
    /// Index of its sample in the silhouette.
    sample: usize,
    height_m: f64,
    /// Sum of the weights over the zone, relative to the weight of the summit, m.
    weight_m: f64,
    /// Means over this zone alone.
    patch: Patch,
}

impl Patch {
    /// A patch that carries the whole load and has `value` in every other quantity.
    fn uniform(value: f64) -> Self {
        Self {
            interpenetration_m: value,
            wheel_y_m: value,
            wheel_z_m: value,
            track_y_m: value,
            slope: value,
            curvature_per_m: value,
            load_fraction: 1.0,
        }
    }

    /// Combines each quantity except the load fraction with that of `other`.
    pub(super) fn zip(&self, other: &Self, function: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            interpenetration_m: function(self.interpenetration_m, other.interpenetration_m),
            wheel_y_m: function(self.wheel_y_m, other.wheel_y_m),
            wheel_z_m: function(self.wheel_z_m, other.wheel_z_m),
            track_y_m: function(self.track_y_m, other.track_y_m),
            slope: function(self.slope, other.slope),
            curvature_per_m: function(self.curvature_per_m, other.curvature_per_m),
            load_fraction: self.load_fraction,
        }
    }
}
