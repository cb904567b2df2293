//! Kalman filter of seven states with its covariance as `U D U'`, U of unit diagonal.
//!
//! An update is Bierman's: the diagonal shrinks by factors between 0 and 1 and never turns negative, in any precision.
//! The position stands first, so that its row of U takes the piston's travel by a few sums and D alone its noise.
//! The work of an update is done in two parts, one a tick.

/// Number of states: position of the piston (m), flow factor (1), compliance (m/N), half clearance (m), lag (s), zero of
/// the force (N), added friction (N).
pub(crate) const STATES: usize = 7;
/// Entries of U above its diagonal.
const UPPER: usize = STATES * (STATES - 1) / 2;
/// The first column of the second part of an update.
const SECOND_PART: usize = 5;
/// State of the position of the piston.
pub(crate) const POSITION: usize = 0;
/// State of the flow factor.
pub(crate) const FLOW: usize = 1;
/// State of the compliance.
pub(crate) const COMPLIANCE: usize = 2;
/// State of half the clearance.
pub(crate) const CLEARANCE: usize = 3;
/// State of the lag.
pub(crate) const LAG: usize = 4;
/// State of the zero of the force.
pub(crate) const ZERO: usize = 5;
/// State of the added friction.
pub(crate) const FRICTION: usize = 6;

/// Estimate and its covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Filter {
    pub(crate) state: [f32; STATES],
    /// Diagonal of D.
    pub(crate) diagonal: [f32; STATES],
    /// Above the diagonal of U: row 0 from column 1, row 1 from column 2 and so on.
    upper: [f32; UPPER],
}

/// A measurement `z = h . state + noise`, prepared against a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Prepared {
    /// `z`, corrected for the force's zero and for friction already.
    pub(crate) measured: f32,
    /// `h` of the parameters; that of the position is 1.
    pub(crate) parts: [f32; STATES - 1],
    /// `U' h`.
    projected: [f32; STATES],
    /// Gains of the columns that were taken in, not yet over the variance.
    gain: [f32; STATES],
    /// Variance of the noise and of the columns that were taken in.
    alpha: f32,
    /// One over it.
    inverse: f32,
    /// `z - h . state`.
    pub(crate) innovation: f32,
    /// Variance of the noise.
    noise: f32,
    /// Variance that the innovation should have.
    pub(crate) variance: f32,
    /// Part of it that comes from the parameters, not from position and noise.
    pub(crate) told: f32,
}

impl Prepared {
    /// Of nothing.
    pub(crate) const NONE: Self = Self {
        measured: 0.0,
        parts: [0.0; STATES - 1],
        projected: [0.0; STATES],
        gain: [0.0; STATES],
        alpha: 0.0,
        inverse: 0.0,
        innovation: 0.0,
        noise: 0.0,
        variance: 0.0,
        told: 0.0,
    };
}

impl Filter {
    pub(crate) const fn new(state: [f32; STATES], diagonal: [f32; STATES]) -> Self {
        Self {
            state,
            diagonal,
            upper: [0.0; UPPER],
        }
    }

    /// Moves the position by the flow factor times a nominal travel (m), which has a variance (m^2) of its own.
    /// `slips` is how much less it moves for each newton of the force's zero and of added friction (m/N).
    #[inline(always)]
    pub(crate) fn travel(&mut self, travel: f32, slips: [f32; 2], variance: f32) {
        self.state[0] += travel * self.state[1];
        self.upper[0] += travel;
        for column in 2..STATES {
            self.upper[place(0, column)] += travel * self.upper[place(1, column)];
        }
        let [zero, friction] = slips;
        self.upper[place(0, ZERO)] -= zero;
        self.upper[place(0, FRICTION)] -= friction + zero * self.upper[place(ZERO, FRICTION)];
        self.diagonal[0] += variance;
    }

    /// Forgets the position but for a variance (m^2).
    #[inline(always)]
    pub(crate) fn let_go(&mut self, variance: f32) {
        self.diagonal[0] = variance;
        self.upper[..STATES - 1].fill(0.0);
    }

    /// Prepares a measurement with a variance of its noise. It was corrected for the force's zero and for friction, so
    /// that these two have no part in the innovation.
    #[inline(always)]
    pub(crate) fn prepare(&self, prepared: &mut Prepared, noise: f32) {
        let h = prepared.parts;
        let mut innovation = prepared.measured - self.state[POSITION];
        let mut told = 0.0;
        prepared.projected[POSITION] = 1.0;
        for column in 1..STATES {
            let mut sum = h[column - 1] + self.upper[place(POSITION, column)];
            for row in 1..column {
                sum += self.upper[place(row, column)] * h[row - 1];
            }
            prepared.projected[column] = sum;
            told += (sum * self.diagonal[column]) * sum;
            if column < ZERO {
                innovation -= self.state[column] * h[column - 1];
            }
        }
        prepared.innovation = innovation;
        prepared.noise = noise;
        prepared.told = told;
        prepared.variance = noise + self.diagonal[POSITION] + told;
    }

    /// Takes the first part of a prepared measurement in.
    #[inline(always)]
    pub(crate) fn update_first(&mut self, prepared: &mut Prepared) {
        let position = self.diagonal[POSITION];
        prepared.gain[POSITION] = position;
        prepared.alpha = prepared.noise + position;
        prepared.inverse = 1.0 / prepared.alpha;
        self.diagonal[POSITION] = position * (prepared.noise * prepared.inverse);
        for column in 1..SECOND_PART {
            self.update_column(prepared, column);
        }
    }

    /// Takes the second part in, and moves the estimate.
    #[inline(always)]
    pub(crate) fn update_second(&mut self, prepared: &mut Prepared) {
        for column in SECOND_PART..STATES {
            self.update_column(prepared, column);
        }
        let scaled = prepared.innovation * prepared.inverse;
        for (state, gain) in self.state.iter_mut().zip(prepared.gain) {
            *state += gain * scaled;
        }
    }

    #[inline(always)]
    fn update_column(&mut self, prepared: &mut Prepared, column: usize) {
        let f = prepared.projected[column];
        let g = self.diagonal[column] * f;
        let before = prepared.alpha;
        let factor = f * prepared.inverse;
        prepared.alpha += f * g;
        prepared.inverse = 1.0 / prepared.alpha;
        self.diagonal[column] *= before * prepared.inverse;
        for row in 0..column {
            let place = place(row, column);
            let u = self.upper[place];
            self.upper[place] = u - prepared.gain[row] * factor;
            prepared.gain[row] += g * u;
        }
        prepared.gain[column] = g;
    }

    /// Variance of a state.
    pub(crate) fn variance(&self, row: usize) -> f32 {
        let mut variance = self.diagonal[row];
        for column in row + 1..STATES {
            let u = self.upper[place(row, column)];
            variance += (u * u) * self.diagonal[column];
        }
        variance
    }
}

/// Where an element of U lies.
const fn place(row: usize, column: usize) -> usize {
    row * (2 * STATES - 3 - row) / 2 + column - 1
}
