//! The part of a branch between two knots: samples, cubics through them and the errors of the cubics.

use super::branch::Branch;
use super::fit;
use crate::math::elementary::sqrt;
use crate::stages::GAMMA;

/// Low force as a fraction of the force limit; see [`Stage::floor`].
const LOW_FORCE: f64 = 1e-3;
/// Low flow as a fraction of the flow at the force limit, for a branch that is closed at low force.
const LOW_FLOW: f64 = 1e-4;

/// Reach, flow and stiffness of an implicit stage at one force.
#[derive(Clone, Copy, Default)]
pub(super) struct Sample {
    /// Reach beyond the held stretch, plus the first knot (m).
    pub(super) reach: f64,
    /// Flow `v_h` times the step (m).
    pub(super) flow: f64,
    /// Ratio of force to stretch (N/m).
    pub(super) stiffness: f64,
}

/// The implicit stages of a branch for one step size.
pub(super) struct Stage<'a> {
    pub(super) branch: &'a Branch<'a>,
    pub(super) step_s: f64,
    pub(super) first_knot: f64,
    /// Flow at low force times the step (m). It is added to the scale of relative errors, because smaller errors hardly
    /// matter at higher forces.
    floor: f64,
}

impl<'a> Stage<'a> {
    pub(super) fn new(branch: &'a Branch<'a>, step_s: f64, first_knot: f64) -> Self {
        let start = branch.friction();
        let low = start + LOW_FORCE * (branch.force_limit - start);
        let flow = |force| step_s * branch.velocity(force);
        Self {
            branch,
            step_s,
            first_knot,
            floor: flow(low).max(LOW_FLOW * flow(branch.force_limit)),
        }
    }

    /// Samples the stage that ends at a force (N).
    pub(super) fn sample(&self, force: f64) -> Sample {
        let flow = self.step_s * self.branch.velocity(force);
        let deflection = self.branch.deflection(force);
        Sample {
            reach: deflection + GAMMA * flow - self.branch.held() + self.first_knot,
            flow,
            stiffness: self.branch.secant_stiffness(force, deflection),
        }
    }
}

/// Number of samples of a span: four nodes of its cubics, and one check point between neighbouring nodes.
const SAMPLES: usize = 7;
const NODES: [usize; 4] = [0, 2, 4, 6];
const CHECKS: [usize; 3] = [1, 3, 5];

/// The part of a branch between two knots.
///
/// Its forces are `F = corner + (width t)^2`, where `corner` is the force of the preceding corner. The flow of some
/// paths starts as a square root of the force, for example that of the orifice at zero force. As functions of t, all
/// quantities are smooth even there.
#[derive(Clone, Copy)]
pub(super) struct Span {
    corner: f64,
    width: f64,
    t: [f64; 2],
    samples: [Sample; SAMPLES],
    /// Largest relative error of the cubics in flow or stiffness (1).
    pub(super) misfit: f64,
}

impl Span {
    /// Samples the span between the forces (N) of two corners.
    pub(super) fn new(stage: &Stage<'_>, from: f64, to: f64) -> Self {
        let mut span = Self {
            corner: from,
            width: sqrt(to - from),
            t: [0.0, 1.0],
            samples: [Sample::default(); SAMPLES],
            misfit: 0.0,
        };
        span.samples[0] = stage.sample(from);
        span.samples[SAMPLES - 1] = stage.sample(to);
        for node in [2, 4] {
            span.samples[node] = stage.sample(span.force(node));
        }
        span.check(stage);
        span
    }

    /// Splits the span in the middle of its range of t.
    pub(super) fn halves(&self, stage: &Stage<'_>) -> [Self; 2] {
        let middle = 0.5 * (self.t[0] + self.t[1]);
        let half = |t: [f64; 2], from: usize| {
            let mut half = Self { t, ..*self };
            for (node, index) in NODES.into_iter().zip(from..) {
                half.samples[node] = self.samples[index];
            }
            half.check(stage);
            half
        };
        [
            half([self.t[0], middle], 0),
            half([middle, self.t[1]], SAMPLES / 2),
        ]
    }

    pub(super) fn start(&self) -> &Sample {
        &self.samples[0]
    }

    pub(super) fn middle(&self) -> &Sample {
        &self.samples[SAMPLES / 2]
    }

    pub(super) fn end(&self) -> &Sample {
        &self.samples[SAMPLES - 1]
    }

    /// Returns a quantity as a cubic in the reach beyond `knot` (m).
    pub(super) fn cubic(&self, knot: f64, quantity: impl Fn(&Sample) -> f64) -> [f64; 4] {
        self.cubic_of(knot, NODES.map(|node| quantity(&self.samples[node])))
    }

    /// Returns the flow potential times the step (m^2) as a cubic, and its value at the end of the span; `start` is its
    /// value at the start.
    pub(super) fn potential(&self, stage: &Stage<'_>, knot: f64, start: f64) -> ([f64; 4], f64) {
        let mut values = [start; NODES.len()];
        for third in 1..values.len() {
            values[third] = values[third - 1] + self.potential_of_third(stage, third - 1);
        }
        (self.cubic_of(knot, values), values[NODES.len() - 1])
    }

    fn cubic_of(&self, knot: f64, values: [f64; 4]) -> [f64; 4] {
        fit::cubic(NODES.map(|node| self.samples[node].reach - knot), values)
    }

    /// Increase of the flow potential times the step over a third of the span (m^2): `integral of h v_h d delta`.
    fn potential_of_third(&self, stage: &Stage<'_>, third: usize) -> f64 {
        /// Three-point Gauss-Legendre rule on [-1, 1] (Abramowitz and Stegun 25.4.29).
        const RULE: [(f64, f64); 3] = [
            (-0.774_596_669_241_483, 5.0 / 9.0),
            (0.0, 8.0 / 9.0),
            (0.774_596_669_241_483, 5.0 / 9.0),
        ];
        let half = (self.t[1] - self.t[0]) / 6.0;
        let middle = self.t[0] + (2 * third + 1) as f64 * half;
        let sum: f64 = RULE
            .iter()
            .map(|(node, weight)| {
                let t = middle + half * node;
                let force = self.force_at(t);
                let force_slope = 2.0 * self.width * self.width * t;
                weight * stage.branch.velocity(force) * stage.branch.compliance(force) * force_slope
            })
            .sum();
        stage.step_s * half * sum
    }

    /// Samples between the nodes and computes the errors of the cubics there.
    fn check(&mut self, stage: &Stage<'_>) {
        for check in CHECKS {
            self.samples[check] = stage.sample(self.force(check));
        }
        let knot = self.start().reach;
        let flow = self.cubic(knot, |sample| sample.flow);
        let stiffness = self.cubic(knot, |sample| sample.stiffness);
        self.misfit = 0.0;
        for sample in CHECKS.map(|check| self.samples[check]) {
            let error = |cubic, value: f64| (fit::value(cubic, sample.reach - knot) - value).abs();
            // The scale includes 1e-5 of the reach for closed branches, which have almost no flow and hold their
            // stretch for seconds.
            let scale = sample.flow + stage.floor + 1e-5 * sample.reach;
            let misfit = (error(flow, sample.flow) / scale)
                .max(error(stiffness, sample.stiffness) / sample.stiffness);
            self.misfit = self.misfit.max(misfit);
        }
    }

    fn force(&self, sample: usize) -> f64 {
        let fraction = sample as f64 / (SAMPLES - 1) as f64;
        self.force_at(self.t[0] + fraction * (self.t[1] - self.t[0]))
    }

    fn force_at(&self, t: f64) -> f64 {
        self.corner + (self.width * t) * (self.width * t)
    }
}
