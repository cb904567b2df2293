//! Places the knots of a branch at its corners, and between them where the cubics have the largest errors.

use heapless::Vec;

use super::span::{Span, Stage};
use crate::bins::DOUBLINGS;
use crate::math::root::bracketed_root;
use crate::real::Real;
use crate::stages::GAMMA;
use crate::table::{FLOW, KNOTS, PIECES, POTENTIAL, Piece, STIFFNESS};

/// A span is not divided if the relative error of its cubics is at most this (1).
const TOLERANCE: f64 = 1e-9;

/// Relative amount by which the table's force at the yield point exceeds the force limit (1). It is larger than the
/// rounding error of `f32`.
const YIELD_MARGIN: f64 = 1e-5;

/// Smallest distance between two knots, relative to the reach at the knots (1). Double precision cannot resolve a cubic
/// over a much shorter span. Two corners can be closer than this, for example if the relief valve opens just as the
/// vapour disappears.
const MIN_SEPARATION: f64 = 1e-9;

/// One span for each piece except the last piece, which is beyond the force limit.
type Spans = Vec<Span, { PIECES - 1 }>;

/// Writes the pieces of a branch. The flow has the sign of `direction`.
pub(super) fn write<T: Real>(stage: &Stage<'_>, direction: f64, pieces: &mut [Piece<T>]) {
    let mut knot_of = pieces.iter_mut();
    let mut potential = 0.0;
    let spans = spans::<T>(stage);
    for (span, piece) in spans.iter().zip(knot_of.by_ref()) {
        piece[KNOTS][0] = T::from_f64(span.start().reach);
        let knot = piece[KNOTS][0].to_f64();
        let flow = span.cubic(knot, |sample| direction * sample.flow);
        let stiffness = span.cubic(knot, |sample| sample.stiffness);
        let (cubic, end) = span.potential(stage, knot, potential);
        potential = end;
        piece[FLOW] = flow.map(T::from_f64);
        piece[STIFFNESS] = stiffness.map(T::from_f64);
        piece[POTENTIAL] = cubic.map(T::from_f64);
    }
    let Some(end) = spans.last().map(Span::end) else {
        return;
    };
    let mut knot = T::from_f64(end.reach);
    let flow = end.flow + (knot.to_f64() - end.reach) / GAMMA;
    for piece in knot_of {
        // Once the element yields, more reach means only more flow, so this piece is exact for any reach.
        let linear = [direction * flow, direction / GAMMA, 0.0, 0.0];
        piece[KNOTS][0] = knot;
        piece[FLOW] = linear.map(T::from_f64);
        piece[STIFFNESS] = constant((1.0 + YIELD_MARGIN) * end.stiffness);
        piece[POTENTIAL] = constant(potential);
        // The step never reaches the remaining pieces.
        knot = T::MAX;
    }
}

fn constant<T: Real>(value: f64) -> [T; 4] {
    [value, 0.0, 0.0, 0.0].map(T::from_f64)
}

/// Divides the branch at its corners, then repeatedly halves the span with the largest error until every piece is used.
fn spans<T: Real>(stage: &Stage<'_>) -> Spans {
    let mut spans: Spans = corners::<T>(stage)
        .windows(2)
        .map(|corners| Span::new(stage, corners[0], corners[1]))
        .collect();
    while !spans.is_full() {
        let misfit = |index: &usize| spans[*index].misfit;
        let worst = (0..spans.len()).max_by(|a, b| misfit(a).total_cmp(&misfit(b)));
        let Some(worst) = worst.filter(|worst| misfit(worst) > TOLERANCE) else {
            break;
        };
        let starts = spans.iter().map(|span| span.start().reach);
        let knots = starts.chain(spans.last().map(|span| span.end().reach));
        if fits::<T>(knots, spans[worst].middle().reach) {
            let [before, after] = spans[worst].halves(stage);
            spans[worst] = before;
            // There is room, because the loop ends when the vector is full.
            let _ = spans.insert(worst + 1, after);
        } else {
            spans[worst].misfit = 0.0;
        }
    }
    spans
}

/// Returns the forces (N) that need a knot, in ascending order: start, corners and end of the branch.
///
/// A corner gets no knot if its bin has one already or another knot is too close. The table then smooths the corner
/// over less than one bin.
fn corners<T: Real>(stage: &Stage<'_>) -> Vec<f64, 10> {
    let (start, end) = (stage.branch.friction(), end(stage));
    let mut forces = Vec::from_array([start, end]);
    for (_, corner) in stage.branch.corners() {
        let knots = forces.iter().map(|force| stage.sample(*force).reach);
        if start < corner && corner < end && fits::<T>(knots, stage.sample(corner).reach) {
            // There is room for all corners of a branch and its two ends.
            let _ = forces.push(corner);
        }
    }
    forces.sort_unstable_by(f64::total_cmp);
    forces
}

/// Returns the force at the end of the table (N): the force limit or, if the bins end at a smaller force, that force.
fn end(stage: &Stage<'_>) -> f64 {
    let limit = stage.branch.force_limit;
    let max_reach = stage.first_knot * f64::from(1_u32 << DOUBLINGS);
    if stage.sample(limit).reach < max_reach {
        return limit;
    }
    bracketed_root(stage.branch.friction(), limit, |force| {
        stage.sample(force).reach - max_reach
    })
}

/// True if the bin of `reach` (m) has no knot yet and no knot is too close.
fn fits<T: Real>(mut knots: impl Iterator<Item = f64>, reach: f64) -> bool {
    let knot = T::from_f64(reach);
    knots.all(|other| {
        let is_apart = (other - reach).abs() > MIN_SEPARATION * reach;
        is_apart && T::from_f64(other).bins() != knot.bins()
    })
}
