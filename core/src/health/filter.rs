//! Kalman filter of seven states. The covariance is stored as `U D U'`, where U has a unit diagonal.
//!
//! The update is Bierman's: it multiplies the diagonal by factors between 0 and 1, so the diagonal never becomes
//! negative in any precision. The position is the first state, so the travel of the piston changes only the first row
//! of U, which takes a few sums. Noise changes only D. An update has two parts, which run in two ticks.

/// Number of states: position of the piston (m), flow factor (1), compliance (m/N), half clearance (m), lag (s), force
/// offset (N), added friction (N). The force offset is the zero offset of the force sensor.
pub(crate) const STATES: usize = 7;
/// Number of entries of U above its diagonal.
const UPPER: usize = STATES * (STATES - 1) / 2;
/// First column of the second part of an update.
const SECOND_PART: usize = 5;
/// Index of the piston position.
pub(crate) const POSITION: usize = 0;
/// Index of the flow factor.
pub(crate) const FLOW: usize = 1;
/// Index of the compliance.
pub(crate) const COMPLIANCE: usize = 2;
/// Index of half the clearance.
pub(crate) const CLEARANCE: usize = 3;
/// Index of the lag.
pub(crate) const LAG: usize = 4;
/// Index of the force offset.
pub(crate) const ZERO: usize = 5;
/// Index of the added friction.
pub(crate) const FRICTION: usize = 6;

/// State estimate and its covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Filter {
    pub(crate) state: [f32; STATES],
    /// Diagonal of D.
    pub(crate) diagonal: [f32; STATES],
    /// Entries of U above its diagonal: row 0 from column 1, row 1 from column 2 and so on.
    upper: [f32; UPPER],
}

/// A measurement `z = h . state + noise`, prepared for a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Prepared {
    /// `z`, already corrected for force offset and friction.
    pub(crate) measured: f32,
    /// `h` of all states except the position, whose entry is 1.
    pub(crate) parts: [f32; STATES - 1],
    /// `U' h`.
    projected: [f32; STATES],
    /// Gains of the processed columns, not yet divided by the variance.
    gain: [f32; STATES],
    /// Variance of the noise plus that of the processed columns.
    alpha: f32,
    /// Inverse of `alpha`.
    inverse: f32,
    /// `z - h . state`.
    pub(crate) innovation: f32,
    /// Variance of the noise.
    noise: f32,
    /// Expected variance of the innovation.
    pub(crate) variance: f32,
    /// Part of the expected variance that is due to the parameters, not to position or noise.
    pub(crate) information: f32,
}

impl Prepared {
    /// A measurement of zeros.
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
        information: 0.0,
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

    /// Moves the position by the flow factor times a nominal travel (m) with an additional variance (m^2). `slips` are
    /// the losses of travel per newton of force offset and per newton of added friction (m/N).
    #[inline(always)]
    pub(crate) fn travel(&mut self, travel: f32, slips: [f32; 2], variance: f32) {
        self.state[0] += travel * self.state[1];
        self.upper[0] += travel;
        for column in 2..STATES {
            self.upper[index(0, column)] += travel * self.upper[index(1, column)];
        }
        let [zero, friction] = slips;
        self.upper[index(0, ZERO)] -= zero;
        self.upper[index(0, FRICTION)] -= friction + zero * self.upper[index(ZERO, FRICTION)];
        self.diagonal[0] += variance;
    }

    /// Forgets the position and sets its variance (m^2).
    #[inline(always)]
    pub(crate) fn forget_position(&mut self, variance: f32) {
        self.diagonal[0] = variance;
        self.upper[..STATES - 1].fill(0.0);
    }

    /// Prepares a measurement whose noise has the variance `noise`.
    ///
    /// The measurement is already corrected for force offset and friction, so the innovation does not subtract them
    /// again.
    #[inline(always)]
    pub(crate) fn prepare(&self, prepared: &mut Prepared, noise: f32) {
        let h = prepared.parts;
        let mut innovation = prepared.measured - self.state[POSITION];
        let mut information = 0.0;
        prepared.projected[POSITION] = 1.0;
        for column in 1..STATES {
            let mut sum = h[column - 1] + self.upper[index(POSITION, column)];
            for row in 1..column {
                sum += self.upper[index(row, column)] * h[row - 1];
            }
            prepared.projected[column] = sum;
            information += (sum * self.diagonal[column]) * sum;
            if column < ZERO {
                innovation -= self.state[column] * h[column - 1];
            }
        }
        prepared.innovation = innovation;
        prepared.noise = noise;
        prepared.information = information;
        prepared.variance = noise + self.diagonal[POSITION] + information;
    }

    /// Does the first part of an update with a prepared measurement.
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

    /// Does the second part of an update and corrects the state.
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
            let entry = index(row, column);
            let u = self.upper[entry];
            self.upper[entry] = u - prepared.gain[row] * factor;
            prepared.gain[row] += g * u;
        }
        prepared.gain[column] = g;
    }

    /// Variance of a state.
    pub(crate) fn variance(&self, row: usize) -> f32 {
        let mut variance = self.diagonal[row];
        for column in row + 1..STATES {
            let u = self.upper[index(row, column)];
            variance += (u * u) * self.diagonal[column];
        }
        variance
    }
}

/// Index of an entry of U in its array.
const fn index(row: usize, column: usize) -> usize {
    row * (2 * STATES - 3 - row) / 2 + column - 1
}

#[cfg(test)]
mod tests;
