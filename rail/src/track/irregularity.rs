//! Irregularities: cubic splines over the distance on a uniform grid.

use super::rails::{Channels, RailDeviation};
use crate::math::spline::Spline;

/// Maximum number of samples of an irregularity: almost 1000 km at 0.25 m, 256 MB.
pub const MAX_SAMPLES: usize = 4_000_000;

/// Number of zeros before the first and after the last sample. The overshoot of the spline decreases by a factor of
/// 0.27 per sample, so it is below rounding at the outermost sample.
const MARGIN: usize = 30;

/// Deviations of the four channels at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Node {
    value_m: [f64; 4],
    /// Slope times spacing, m.
    rise_m: [f64; 4],
}

const ZERO: Node = Node {
    value_m: [0.0; 4],
    rise_m: [0.0; 4],
};

/// Deviations of a track from its layout, as functions of the distance. They are zero outside [`Irregularity::ends_m`].
///
/// [`Generation::irregularity`](super::Generation::irregularity) creates them from a spectrum,
/// [`measured::parse`](super::measured::parse) from a file. The cost of an evaluation is constant: it finds the node by
/// index and evaluates a cubic polynomial between two nodes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Irregularity {
    first_node_m: f64,
    nodes_per_m: f64,
    nodes: Vec<Node>,
    ends_m: [f64; 2],
}

impl Default for Irregularity {
    /// Returns zero deviations.
    fn default() -> Self {
        Self {
            first_node_m: 0.0,
            nodes_per_m: 1.0,
            nodes: vec![ZERO; 2],
            ends_m: [0.0; 2],
        }
    }
}

impl Irregularity {
    /// Interpolates `samples`, which start at `start_m` and are `spacing_m` apart, with raised-cosine ramps over
    /// `ramp_m` at both ends.
    pub(super) fn through(start_m: f64, spacing_m: f64, ramp_m: f64, samples: &[[f64; 4]]) -> Self {
        let length_m = spacing_m * samples.len().saturating_sub(1) as f64;
        let mut nodes = vec![ZERO; samples.len() + 2 * MARGIN];
        for (i, sample) in samples.iter().enumerate() {
            let from_start_m = spacing_m * i as f64;
            let weight = raised_cosine(from_start_m / ramp_m)
                * raised_cosine((length_m - from_start_m) / ramp_m);
            nodes[MARGIN + i].value_m = sample.map(|value| weight * value);
        }
        let knots: Vec<f64> = (0..nodes.len()).map(|i| i as f64).collect();
        for channel in 0..4 {
            let values: Vec<f64> = nodes.iter().map(|node| node.value_m[channel]).collect();
            let spline = Spline::fit(&knots, &values, 0.0);
            for (node, knot) in nodes.iter_mut().zip(&knots) {
                node.rise_m[channel] = spline.at(*knot)[1];
            }
        }
        let last = nodes.len() - 1;
        (nodes[0], nodes[last]) = (ZERO, ZERO);
        Self {
            first_node_m: start_m - spacing_m * MARGIN as f64,
            nodes_per_m: 1.0 / spacing_m,
            nodes,
            ends_m: [start_m, start_m + length_m],
        }
    }

    /// Returns the distances of the first and the last sample, m.
    ///
    /// The spline overshoots for a few spacings beyond them: by 1e-7 m for ramps of 50 m and deviations of 20 mm.
    pub fn ends_m(&self) -> [f64; 2] {
        self.ends_m
    }

    /// Returns the distance between samples, m.
    pub fn spacing_m(&self) -> f64 {
        1.0 / self.nodes_per_m
    }

    /// Returns the deviations of the left and the right rail at a distance; NaN if the distance is NaN.
    #[inline]
    pub fn at(&self, distance_m: f64) -> [RailDeviation; 2] {
        let [deviations, slopes] = self.channels(distance_m);
        RailDeviation::left_and_right(&deviations, &slopes)
    }

    /// Returns the deviations of the track at a distance, m, and their slopes, dimensionless.
    #[inline]
    pub fn channels(&self, distance_m: f64) -> [Channels; 2] {
        let position = (distance_m - self.first_node_m) * self.nodes_per_m;
        let last = self.nodes.len() - 1;
        if position < 0.0 || position >= last as f64 {
            return [Channels::default(); 2];
        }
        // For a NaN distance, the index is 0 and `t` is NaN.
        let index = position as usize;
        let (from, to) = (&self.nodes[index], &self.nodes[index + 1]);
        let t = position - index as f64;
        let (mut values, mut slopes) = ([0.0; 4], [0.0; 4]);
        for channel in 0..4 {
            // Cubic Hermite polynomial through the values and slopes of both nodes.
            let (v0, r0) = (from.value_m[channel], from.rise_m[channel]);
            let (chord, r1) = (to.value_m[channel] - v0, to.rise_m[channel]);
            let square = 3.0 * chord - 2.0 * r0 - r1;
            let cube = r0 + r1 - 2.0 * chord;
            values[channel] = v0 + t * (r0 + t * (square + t * cube));
            slopes[channel] = (r0 + t * (2.0 * square + t * 3.0 * cube)) * self.nodes_per_m;
        }
        [Channels::from_array(values), Channels::from_array(slopes)]
    }
}

/// Rises from 0 to 1 while `t` does, with zero slope at both ends.
fn raised_cosine(t: f64) -> f64 {
    0.5 - 0.5 * libm::cos(std::f64::consts::PI * t.clamp(0.0, 1.0))
}
