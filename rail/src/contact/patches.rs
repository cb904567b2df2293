//! Where a wheel touches its rail: a contact patch at the summit of each of its zones.

use std::ops::Range;

use super::hertz::{Hertz, Steel};
use super::pair::Pair;
use super::silhouette::{SilhouettePoint, TurnedWheel};
use super::zones::{ZONES, Zones};

/// Softness of the contact over Hertz's penetration.
///
/// With a quarter the place of contact is that of an elastic half-space within 0.15 mm; the hundredth more takes half
/// of the remaining error off the steering forces near the centre.
const SOFTNESS_RATIO: f64 = 0.26;
/// Transverse curvature of the contact whose penetration sets the softness, 1/m: the top of a rail of R 300.
const TYPICAL_CURVATURE_PER_M: f64 = 1.0 / 0.3;

/// Softness of the contact of a wheel of `wheel_radius_m` under `load_n`, m: over this interpenetration the
/// weight of a point falls to `1/e`. It is 0.26 of Hertz's penetration on a rail head of R 300.
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
/// Every quantity is a mean over the silhouette of its zone with weights `exp(normal height / softness)`, so that it
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
    /// Fraction of the load at `interpenetration_m` and `curvature_per_m` that the patch carries, 0 to 1: below 1 where
    /// no valley separates it from a neighbour.
    pub load_fraction: f64,
}

/// Depth of the valley from which two patches are separate, in lengths of the softness.
const SEPARATION: f64 = 4.0;
/// Interpenetration of a zone that is nowhere over the rail, m: far above it.
const ABSENT_M: f64 = -0.05;
/// Weights below `exp` of this are left out.
const LEAST_EXPONENT: f64 = -20.0;

impl TurnedWheel<'_> {
    /// The patches of the wheel's `zones` when it is shifted by `lateral_m`, from the flange to the field side; `scratch` is
    /// working memory that is overwritten.
    ///
    /// Two summits with a valley `v` between them belong together by `1 - S(v / 4 softness)` with the smooth step `S`.
    /// Each patch carries its own load by its own interpenetration and curvature once it belongs to itself alone; as long as it
    /// belongs to others too, interpenetration and curvature are weighted means over all of them and it carries its
    /// share of their one load. Sums over a wheel therefore do not change where a summit divides or two merge.
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
            // How far each summit belongs together with this one.
            let together = summits.each_ref().map(|other| {
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
            let relatives = || {
                let pairs = summits.iter().zip(together);
                pairs
                    .filter_map(|(other, together)| Some((other.as_ref()?, together)))
                    .filter(|(_, together)| *together > 0.0)
            };
            let highest = relatives().fold(own.height_m, |highest, (other, _)| {
                highest.max(other.height_m)
            });
            let weight = |summit: &Summit| {
                summit.weight_m * ((summit.height_m - highest) / softness_m).exp()
            };
            let mut total = 0.0;
            let (mut interpenetration, mut curvature) = (0.0, 0.0);
            for (other, together) in relatives() {
                let weight = together * weight(other);
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

    /// The summit of the part of the wheel within `zone` (m from the tread datum); `None` where it is nowhere over the rail.
    fn summit(
        &self,
        silhouette: &[SilhouettePoint],
        zone: Range<f64>,
        softness: f64,
    ) -> Option<Summit> {
        // A sample stands for the wheel up to the middle of its neighbours, and for its zone as far as that lies within.
        let points = self.pair().wheel().points();
        let middle = |i: usize, j: usize| 0.5 * (points[i].y_m + points[j].y_m);
        let left = |i: usize| middle(i.saturating_sub(1), i);
        let right = |i: usize| middle(i, (i + 1).min(points.len() - 1));
        let first = silhouette.partition_point(|p| right(p.index) <= zone.start);
        let end = silhouette.partition_point(|p| left(p.index) < zone.end);
        let height = |i: usize| silhouette[i].normal_height_m;
        let sample = (first..end).max_by(|&i, &j| height(i).total_cmp(&height(j)))?;
        let mut weight_m = 0.0;
        let mut sum = [0.0; 6];
        for point in &silhouette[first..end] {
            let exponent = (point.normal_height_m - height(sample)) / softness;
            if exponent < LEAST_EXPONENT {
                continue;
            }
            let width = right(point.index).min(zone.end) - left(point.index).max(zone.start);
            let weight = exponent.exp() * width;
            weight_m += weight;
            for (sum, term) in sum.iter_mut().zip(self.pair().quantities(point)) {
                *sum += weight * term;
            }
        }
        if weight_m <= 0.0 {
            return None;
        }
        let mut patch = Patch::from_quantities(sum.map(|sum| sum / weight_m));
        // The mean over a parabola lies half the softness, along the normal, below its vertex.
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

/// The greatest interpenetration of one zone.
struct Summit {
    /// Its sample of the silhouette.
    sample: usize,
    height_m: f64,
    /// Sum of the weights over the zone, relative to that of the summit, m.
    weight_m: f64,
    /// The zone's own means.
    patch: Patch,
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
