//! The part of a branch between two knots: samples, cubics through them and the errors of the cubics.

use core::cell::RefCell;

use heapless::HistoryBuf;

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
    /// Flow at low force times the step (m). Errors are divided by a scale that includes this flow, because errors far
    /// below it hardly matter at higher forces.
    floor: f64,
    /// Forces (N) that were sampled one by one, with their samples.
    kept: RefCell<HistoryBuf<(f64, Sample), 8>>,
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
            kept: RefCell::new(HistoryBuf::new()),
        }
    }

    /// Samples the stage that ends at a force (N).
    ///
    /// The ends and the corners of a branch are sampled many times, so the last samples are kept.
    pub(super) fn sample(&self, force: f64) -> Sample {
        let mut kept = self.kept.borrow_mut();
        if let Some((_, sample)) = kept.oldest_ordered().find(|(of, _)| *of == force) {
            return *sample;
        }
        let [(sample, _)] = self.samples([force]);
        kept.write((force, sample));
        sample
    }

    /// Samples the stages that end at several forces (N), each with its velocity `v_h` (m/s).
    fn samples<const N: usize>(&self, forces: [f64; N]) -> [(Sample, f64); N] {
        let chambers = forces.map(|force| self.branch.chamber(force));
        let velocities = self.branch.velocities(chambers);
        core::array::from_fn(|index| {
            let (chamber, velocity) = (&chambers[index], velocities[index]);
            let flow = self.step_s * velocity;
            let deflection = self.branch.deflection_of(chamber);
            let sample = Sample {
                reach: deflection + GAMMA * flow - self.branch.held() + self.first_knot,
                flow,
                stiffness: self.branch.secant_stiffness(chamber, deflection),
            };
            (sample, velocity)
        })
    }
}

/// Number of samples of a span: four nodes of its cubics, and one check point between neighbouring nodes.
const SAMPLES: usize = 7;
const NODES: [usize; 4] = [0, 2, 4, 6];
const CHECKS: [usize; 3] = [1, 3, 5];

/// Three-point Gauss-Legendre rule on [-1, 1] (Abramowitz and Stegun 25.4.29), for each third of a span.
const RULE: [(f64, f64); 3] = [
    (-0.774_596_669_241_483, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483, 5.0 / 9.0),
];
const THIRDS: usize = NODES.len() - 1;
const POINTS: usize = THIRDS * RULE.len();
/// Points in the middle of the first two thirds, where the first two checks are, and the others. The last point comes
/// twice, as pairs are solved at a time.
const MIDDLES: [usize; 2] = [1, 4];
const OTHERS: [usize; 8] = [0, 2, 3, 5, 6, 7, 8, 8];

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
    /// Velocities at the check points (m/s).
    velocities: [f64; CHECKS.len()],
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
            velocities: [0.0; CHECKS.len()],
            misfit: 0.0,
        };
        let forces = [from, span.force(2), span.force(4), to];
        let nodes = stage.samples(forces);
        for (node, (sample, _)) in NODES.into_iter().zip(nodes) {
            span.samples[node] = sample;
        }
        span.check(stage, stage.samples(span.checked_forces()));
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
            half
        };
        let mut before = half([self.t[0], middle], 0);
        let mut after = half([middle, self.t[1]], SAMPLES / 2);
        let ([a, b, c], [d, e, f]) = (before.checked_forces(), after.checked_forces());
        let [a, b, c, d, e, f] = stage.samples([a, b, c, d, e, f]);
        before.check(stage, [a, b, c]);
        after.check(stage, [d, e, f]);
        [before, after]
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
        let rates = self.potential_rates(stage);
        let half = self.half_third();
        for third in 0..THIRDS {
            let sum: f64 = RULE
                .iter()
                .zip(&rates[RULE.len() * third..])
                .map(|((_, weight), [velocity, compliance, slope])| {
                    weight * velocity * compliance * slope
                })
                .sum();
            values[third + 1] = values[third] + stage.step_s * half * sum;
        }
        (self.cubic_of(knot, values), values[NODES.len() - 1])
    }

    /// Velocity `v_h` (m/s), compliance `d delta/dF` (m/N) and slope `dF/dt` (N) at the points of the rule in each
    /// third of the span.
    fn potential_rates(&self, stage: &Stage<'_>) -> [[f64; 3]; POINTS] {
        let half = self.half_third();
        let t: [f64; POINTS] = core::array::from_fn(|point| {
            let middle = self.t[0] + (2 * (point / RULE.len()) + 1) as f64 * half;
            middle + half * RULE[point % RULE.len()].0
        });
        let chambers = t.map(|t| stage.branch.chamber(self.force_at(t)));
        let mut velocities = [0.0; POINTS];
        let others = stage.branch.velocities(OTHERS.map(|point| chambers[point]));
        for (point, velocity) in OTHERS.into_iter().zip(others) {
            velocities[point] = velocity;
        }
        for (middle, check) in MIDDLES.into_iter().zip([0, 1]) {
            let is_known = chambers[middle].force_n == self.force(CHECKS[check]);
            velocities[middle] = if is_known {
                self.velocities[check]
            } else {
                stage.branch.velocity(chambers[middle].force_n)
            };
        }
        core::array::from_fn(|point| {
            [
                velocities[point],
                stage.branch.compliance(&chambers[point]),
                2.0 * self.width * self.width * t[point],
            ]
        })
    }

    /// Half of a third of the range of t.
    fn half_third(&self) -> f64 {
        (self.t[1] - self.t[0]) / 6.0
    }

    fn cubic_of(&self, knot: f64, values: [f64; 4]) -> [f64; 4] {
        fit::cubic(NODES.map(|node| self.samples[node].reach - knot), values)
    }

    /// Forces of the check points (N).
    fn checked_forces(&self) -> [f64; CHECKS.len()] {
        CHECKS.map(|check| self.force(check))
    }

    /// Takes the samples at the check points, with their velocities, and computes the errors of the cubics there.
    fn check(&mut self, stage: &Stage<'_>, checked: [(Sample, f64); CHECKS.len()]) {
        for (check, (sample, _)) in CHECKS.into_iter().zip(checked) {
            self.samples[check] = sample;
        }
        self.velocities = checked.map(|(_, velocity)| velocity);
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
