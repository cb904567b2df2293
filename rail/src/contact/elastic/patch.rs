//! Patches of an elastic contact: what the creep forces need of the loads on its strips.

use std::array::from_fn;
use std::f64::consts::PI;

use super::connection::Connection;
use super::gap::Gap;
use super::half_space::peak_pressure;
use super::normal::NormalContact;
use super::strips::Strip;
use crate::contact::pair::Pair;
use crate::contact::zones::ZONES;

/// Valleys of the load that leave two summits one patch, and that divide them.
const LOAD_VALLEYS: [f64; 2] = [0.5, 0.0];
/// Valleys of the overlap that leave two summits one patch, and that divide them: overlaps that touch are one patch,
/// and overlaps that nearly touch are nearly one.
const OVERLAP_VALLEYS: [f64; 2] = [0.0, -0.5];

/// One elastic patch: the part of a contact within one zone of the wheel.
///
/// Several zones may share one patch. Then each has a part of the load, and the size of the whole patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ElasticPatch {
    /// Normal load in the zone, N.
    pub load_n: f64,
    /// `dz/dy` of the wheel in its pose: the tangent of the contact angle. As in the theory of half-spaces, the
    /// pressure acts along one normal: the mean over the same area, with the same weights as the position.
    pub slope: f64,
    /// Position on the wheel at which the creepages hold, m from the tread datum: the mean over the area in which the
    /// undeformed bodies overlap, weighted by the square of their overlap.
    pub wheel_y_m: f64,
    /// Depth on the wheel at this position, m; the rolling radius is the wheel radius plus this depth.
    pub wheel_z_m: f64,
    /// Semi-axes `[a, b]` (rolling direction, across) of the ellipse with the area of the patch and the spread of its
    /// load across, m.
    pub semi_axes_m: [f64; 2],
    /// Normal load of the whole patch, N.
    pub whole_load_n: f64,
    /// Maximum pressure, Pa.
    pub peak_pressure_pa: f64,
}

impl NormalContact {
    /// The patch in each zone; `ends_m` are the ends of all zones but the last on the wheel, m from the tread datum.
    pub(super) fn patches(
        &self,
        gap: &Gap,
        pair: &Pair,
        ends_m: &[f64; ZONES - 1],
    ) -> [ElasticPatch; ZONES] {
        let strips = &gap.strips;
        // A strip on the boundary of two zones belongs to both, by its width.
        let shares = |i: usize| -> [f64; ZONES] {
            let (y, half) = (strips[i].wheel_y_m, 0.5 * strips[i].width_m);
            let before = |zone: usize| match zone.checked_sub(1).map(|end| ends_m.get(end)) {
                None => 0.0,
                Some(None) => 1.0,
                Some(Some(end)) => (0.5 + 0.5 * (end - y) / half).clamp(0.0, 1.0),
            };
            from_fn(|zone| before(zone + 1) - before(zone))
        };
        let is_overlapping = |depth: &f64| *depth > 0.0;
        let first = self.penetrations_m.iter().position(is_overlapping);
        let last = self.penetrations_m.iter().rposition(is_overlapping);
        let (Some(first), Some(last)) = (first, last) else {
            return [ElasticPatch::default(); ZONES];
        };
        let between: Vec<usize> = (first..=last).collect();
        let overlap = Connection {
            strips: &between,
            heights: &self.penetrations_m[first..=last],
            valleys: OVERLAP_VALLEYS,
        };
        let load = Connection {
            strips: &self.loaded,
            heights: &self.line_loads,
            valleys: LOAD_VALLEYS,
        };
        let place = |entry: usize| self.place(strips, &overlap, entry);
        let size = |entry: usize| self.size(strips, &load, entry);
        let one_place = overlap.is_one_patch().then(|| place(0));
        let one_size = load.is_one_patch().then(|| size(0));
        let mut sums = [Sums::default(); ZONES];
        for (k, &i) in self.loaded.iter().enumerate() {
            // A loaded strip overlaps the rail; rounding may leave one out that has no load.
            if !(first..=last).contains(&i) || self.penetrations_m[i] <= 0.0 {
                continue;
            }
            let place = one_place.unwrap_or_else(|| place(i - first));
            let size = one_size.unwrap_or_else(|| size(k));
            let load_n = self.line_loads[k] * strips[i].width_m;
            for (sums, share) in sums.iter_mut().zip(shares(i)) {
                if share > 0.0 {
                    sums.add(share * load_n, &place, &size);
                }
            }
        }
        sums.map(|sums| sums.patch(pair))
    }

    /// Position and normal of the patch around the strip with number `entry` in `overlap`.
    fn place(&self, strips: &[Strip], overlap: &Connection<'_>, entry: usize) -> Place {
        let mut total = 0.0;
        let mut sum = Place::default();
        overlap.each(entry, |other, degree| {
            let strip = &strips[overlap.strips[other]];
            let depth = overlap.heights[other].max(0.0);
            // The overlap of a strip is a parabola in the rolling direction: its square is `depth^2.5` over the length.
            let weight = degree * depth * depth * depth.sqrt() * strip.width_m;
            total += weight;
            sum.wheel_y += weight * strip.wheel_y_m;
            sum.normal[0] += weight * strip.cos * strip.slope;
            sum.normal[1] += weight * strip.cos;
        });
        Place {
            wheel_y: sum.wheel_y / total,
            normal: sum.normal.map(|component| component / total),
        }
    }

    /// Size and load of the patch around the strip with number `entry` in `load`.
    fn size(&self, strips: &[Strip], load: &Connection<'_>, entry: usize) -> Size {
        let mut size = Size::default();
        let (mut area, mut first, mut second) = (0.0, 0.0, 0.0);
        let origin = &strips[load.strips[entry]];
        load.each(entry, |other, degree| {
            let (i, line_load) = (load.strips[other], load.heights[other]);
            let (strip, half_length) = (&strips[i], self.half_lengths_m[i]);
            let pressure = degree * peak_pressure(line_load, half_length);
            size.peak_pressure = size.peak_pressure.max(pressure);
            area += degree * 2.0 * half_length * strip.width_m;
            let part = degree * line_load * strip.width_m;
            let distance = strip.arc_m - origin.arc_m;
            size.load += part;
            first += part * distance;
            second += part * distance * distance;
        });
        let mean = first / size.load;
        let own = origin.width_m * origin.width_m / 12.0;
        // The load of an elliptical patch has the variance b^2/5 across.
        let b = (5.0 * (second / size.load - mean * mean + own)).sqrt();
        size.semi_axes = [area / (PI * b), b];
        size
    }
}

/// Position and normal of a whole patch.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    wheel_y: f64,
    /// Components of the normal: across, and down.
    normal: [f64; 2],
}

/// Size and load of a whole patch.
#[derive(Debug, Clone, Copy, Default)]
struct Size {
    load: f64,
    semi_axes: [f64; 2],
    peak_pressure: f64,
}

/// Sums over the strips of one zone, weighted by their loads.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    load: f64,
    wheel_y: f64,
    normal: [f64; 2],
    semi_axes: [f64; 2],
    whole_load: f64,
    peak_pressure: f64,
}

impl Sums {
    fn add(&mut self, load: f64, place: &Place, size: &Size) {
        self.load += load;
        self.wheel_y += load * place.wheel_y;
        for (sum, component) in self.normal.iter_mut().zip(place.normal) {
            *sum += load * component;
        }
        for (sum, semi_axis) in self.semi_axes.iter_mut().zip(size.semi_axes) {
            *sum += load * semi_axis;
        }
        self.whole_load += load * size.load;
        self.peak_pressure += load * size.peak_pressure;
    }

    fn patch(self, pair: &Pair) -> ElasticPatch {
        if self.load <= 0.0 {
            return ElasticPatch::default();
        }
        let mean = 1.0 / self.load;
        let wheel_y_m = self.wheel_y * mean;
        ElasticPatch {
            load_n: self.load,
            slope: self.normal[0] / self.normal[1],
            wheel_y_m,
            wheel_z_m: pair.wheel().at(wheel_y_m).z_m,
            semi_axes_m: self.semi_axes.map(|sum| sum * mean),
            whole_load_n: self.whole_load * mean,
            peak_pressure_pa: self.peak_pressure * mean,
        }
    }
}
