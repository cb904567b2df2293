//! Lateral and yaw balance of the body, and their normal equations second by second.

use dashpot_rail::vehicle::GRAVITY_M_PER_S2;
use nalgebra::{DMatrix, DVector};

use super::error::SensorsError;
use super::law::Force;
use super::layout::{Connection, Layout};
use super::motion::Rigid;
use super::transform::Spectrum;

/// Corner of the low pass (Hz), above which a real body bends.
const LOW_PASS_HZ: f64 = 6.0;
/// Rate of the equations (Hz).
const RATE_HZ: f64 = 100.0;
/// Duration that is left out at the start and at the end of a piece (s): ramps of the window and settling.
const LEFT_OUT_S: [f64; 2] = [5.0, 2.0];

/// Normal equations `matrix x = vector` of one second.
pub(super) struct Block {
    pub matrix: DMatrix<f64>,
    pub vector: DVector<f64>,
    /// Sum of the squared left sides.
    pub square: f64,
    /// True if the body reached a lateral stop, whose force the balance does not have.
    pub at_stop: bool,
}

/// One signal of the balance (N) and the factor to which it belongs, `None` on the left side.
struct Term {
    factor: Option<usize>,
    signal: Vec<f64>,
    /// Coefficients in the lateral and in the yaw equation.
    coefficients: [f64; 2],
}

/// Returns the normal equations of each second of a piece.
///
/// # Errors
/// A damper cannot be built.
pub(super) fn blocks(
    layout: &Layout,
    duration_s: f64,
    motion: &[Rigid; 3],
) -> Result<Vec<Block>, SensorsError> {
    let terms = terms(layout, motion)?;
    let stops = layout.stops.iter().filter_map(|stop| match stop.force {
        Force::Stop { gap_m } => Some((gap_m, lateral(layout, motion, stop).signal(RATE_HZ).1)),
        _ => None,
    });
    let stops: Vec<(f64, Vec<f64>)> = stops.collect();
    let [before, after] = LEFT_OUT_S.map(|left_out_s| (left_out_s * RATE_HZ) as usize);
    let second = RATE_HZ as usize;
    let rows = (duration_s * RATE_HZ).round() as usize;
    let count = rows.saturating_sub(before + after) / second;
    let factors = layout.factor_names().len();
    let blocks = (0..count).map(|block| {
        let rows = before + block * second..before + (block + 1) * second;
        let is_beyond = |(gap_m, signal): &(f64, Vec<f64>)| {
            signal[rows.clone()].iter().any(|x| x.abs() > *gap_m)
        };
        let mut block = Block {
            matrix: DMatrix::zeros(factors, factors),
            vector: DVector::zeros(factors),
            square: 0.0,
            at_stop: stops.iter().any(is_beyond),
        };
        for row in rows {
            for equation in 0..2 {
                block.add(&terms, row, equation);
            }
        }
        block
    });
    Ok(blocks.collect())
}

impl Block {
    fn add(&mut self, terms: &[Term], row: usize, equation: usize) {
        let mut right = DVector::zeros(self.vector.len());
        let mut left = 0.0;
        for term in terms {
            let value = term.signal[row] * term.coefficients[equation];
            match term.factor {
                Some(factor) => right[factor] += value,
                None => left += value,
            }
        }
        self.square += left * left;
        self.vector.axpy(left, &right, 1.0);
        self.matrix.ger(1.0, &right, &right, 1.0);
    }
}

/// Displacement of the body from the bogie across the track, at a connection (m).
fn lateral(layout: &Layout, motion: &[Rigid; 3], at: &Connection) -> Spectrum {
    let [x, _, height] = at.at_m;
    let [body, bogie] = [0, 1 + at.bogie].map(|number| (&layout.bodies[number], &motion[number]));
    let ahead = x + body.0.x_m - bogie.0.x_m;
    body.1.lateral.sum(
        1.0,
        &[
            (x, &body.1.yaw),
            (height - body.0.height_m, &body.1.roll),
            (-1.0, &bogie.1.lateral),
            (-ahead, &bogie.1.yaw),
            (bogie.0.height_m - height, &bogie.1.roll),
        ],
    )
}

/// Returns all signals of both equations: `m (y'' - g roll) - lean = -forces` and, divided by the distance `l` of the
/// pivots, `I yaw''/l - lean x/l = -forces x/l + longitudinal forces y/l`.
fn terms(layout: &Layout, motion: &[Rigid; 3]) -> Result<Vec<Term>, SensorsError> {
    let low_pass = |w: f64| 1.0 / (1.0 + (w / (std::f64::consts::TAU * LOW_PASS_HZ)).powi(4));
    let mut terms = Vec::new();
    let mut add = |factor: Option<usize>, spectrum: &Spectrum, coefficients: [f64; 2]| {
        let (_, signal) = spectrum.scaled(low_pass).signal(RATE_HZ);
        terms.push(Term {
            factor,
            signal,
            coefficients,
        });
    };
    let body = &layout.bodies[0];
    let ahead = [1, 2].map(|bogie| layout.bodies[bogie].x_m - body.x_m);
    let span = ahead[0] - ahead[1];
    let arm = 0.5 * span;
    add(None, &motion[0].reading, [body.mass_kg, 0.0]);
    add(
        None,
        &motion[0].yaw_acceleration,
        [0.0, body.inertia_kg_m2[2] / arm],
    );
    for (bogie, share) in [(0, -ahead[1] / span), (1, ahead[0] / span)] {
        // The springs' static load leans by half of the roll between bogie and body.
        let lean = motion[1 + bogie].roll.sum(0.5, &[(-0.5, &motion[0].roll)]);
        let load = body.mass_kg * GRAVITY_M_PER_S2 * share;
        add(None, &lean, [-load, -load * ahead[bogie] / arm]);
    }
    let dampers = layout
        .dampers
        .iter()
        .enumerate()
        .map(|(number, damper)| (2 + number, damper));
    let springs = layout.springs.iter().map(|spring| (spring.bogie, spring));
    for (factor, force) in springs.chain(dampers) {
        let displacement = lateral(layout, motion, force);
        let spectrum = force.force.over(&force.name, &displacement, force.sign)?;
        add(Some(factor), &spectrum, [-1.0, -force.at_m[0] / arm]);
    }
    for (number, bogie) in layout.yaw_bogies().enumerate() {
        for force in layout.yaw.iter().filter(|force| force.bogie == bogie) {
            let y = force.at_m[1];
            let displacement = motion[0].yaw.sum(-y, &[(y, &motion[1 + bogie].yaw)]);
            let spectrum = force.force.over(&force.name, &displacement, force.sign)?;
            add(
                Some(2 + layout.dampers.len() + number),
                &spectrum,
                [0.0, y / arm],
            );
        }
    }
    Ok(terms)
}
