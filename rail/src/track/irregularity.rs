//! Deviations over the distance: a twice differentiable cubic spline on a uniform grid.

use super::rails::{Channels, RailDeviation};
use crate::math::spline::Spline;

/// Number of zeros before the first and behind the last sample. What the spline overshoots falls by 0.27 from one to the next,
/// so that at the outermost it is below rounding.
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

/// Deviations of a track from its layout over the distance, zero outside of [`Irregularity::ends_m`].
///
/// Made by [`Generation::irregularity`](super::Generation::irregularity) from a spectrum or by [`measured::parse`](super::measured::parse)
/// from a file. Each evaluation costs the same: the node is found by index, a cubic lies between two nodes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Irregularity {
    first_node_m: f64,
    nodes_per_m: f64,
    nodes: Vec<Node>,
    ends_m: [f64; 2],
}

impl Default for Irregularity {
    /// No deviation.
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
    /// Through `samples` from the distance `start_m` on, `spacing_m` apart, each raised-cosine ramped over `ramp_m` at both ends.
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

    /// First and last sample, m.
    ///
    /// Beyond them the spline overshoots over some spacings before it is zero: by 1e-7 m with ramps of 50 m and 20 mm of deviation.
    pub fn ends_m(&self) -> [f64; 2] {
        self.ends_m
    }

    /// Distance of the samples, m.
    pub fn spacing_m(&self) -> f64 {
        1.0 / self.nodes_per_m
    }

    /// Deviations of the left and of the right rail at a distance; NaN at a distance that is NaN.
    #[inline]
    pub fn at(&self, distance_m: f64) -> [RailDeviation; 2] {
        let [deviations, slopes] = self.channels(distance_m);
        RailDeviation::of_rails(&deviations, &slopes)
    }

    /// Deviations of the track at a distance, m, and their slopes, dimensionless.
    #[inline]
    pub fn channels(&self, distance_m: f64) -> [Channels; 2] {
        let position = (distance_m - self.first_node_m) * self.nodes_per_m;
        let last = self.nodes.len() - 1;
        if position < 0.0 || position >= last as f64 {
            return [Channels::default(); 2];
        }
        // NaN becomes 0 here and stays NaN in the place.
        let index = (position as usize).min(last - 1);
        let (from, to) = (&self.nodes[index], &self.nodes[index + 1]);
        let t = position - index as f64;
        let (mut values, mut slopes) = ([0.0; 4], [0.0; 4]);
        for channel in 0..4 {
            // Hermite's cubic through values and slopes of both nodes.
            let (v0, r0) = (from.value_m[channel], from.rise_m[channel]);
            let (chord, r1) = (to.value_m[channel] - v0, to.rise_m[channel]);
            let square = 3.0 * chord - 2.0 * r0 - r1;
            let cube = r0 + r1 - 2.0 * chord;
            values[channel] = v0 + t * (r0 + t * (square + t * cube));
            slopes[channel] = (r0 + t * (2.0 * square + t * 3.0 * cube)) * self.nodes_per_m;
        }
        [Channels::of(values), Channels::of(slopes)]
    }
}

/// From 0 to 1 as `t` does, with level ends.
fn raised_cosine(t: f64) -> f64 {
    0.5 - 0.5 * libm::cos(std::f64::consts::PI * t.clamp(0.0, 1.0))
}
