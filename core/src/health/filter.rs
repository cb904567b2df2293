//! Kalman filter of five states with its covariance as `U D U'`, U of unit diagonal.
//!
//! An update is Bierman's: the diagonal shrinks by factors between 0 and 1 and never turns negative, in any precision.
//! The position stands first, so that its row of U takes the piston's travel by three sums and D alone its noise.

/// Number of states: position of the piston (m), flow factor (1), compliance (m/N), half clearance (m), lag (s).
pub(crate) const STATES: usize = 5;

/// Estimate and its covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Filter {
    pub(crate) state: [f32; STATES],
    /// Diagonal of D.
    pub(crate) diagonal: [f32; STATES],
    /// Above the diagonal of U: row 0 from column 1, row 1 from column 2 and so on.
    upper: [f32; 10],
}

/// A measurement `z = h . state + noise`, prepared against a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Prepared {
    /// `U' h`.
    projected: [f32; STATES],
    /// `z - h . state`.
    pub(crate) innovation: f32,
    /// Variance of the noise.
    noise: f32,
    /// Variance that the innovation should have.
    pub(crate) variance: f32,
    /// Part of it that comes of the parameters, not of position and noise.
    pub(crate) told: f32,
}

impl Prepared {
    /// Of nothing.
    pub(crate) const NONE: Self = Self {
        projected: [0.0; STATES],
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
            upper: [0.0; 10],
        }
    }

    /// Moves the position by the flow factor times a nominal travel (m), which has a variance (m^2) of its own.
    #[inline(always)]
    pub(crate) fn travel(&mut self, travel: f32, variance: f32) {
        self.state[0] += travel * self.state[1];
        self.upper[0] += travel;
        self.upper[1] += travel * self.upper[4];
        self.upper[2] += travel * self.upper[5];
        self.upper[3] += travel * self.upper[6];
        self.diagonal[0] += variance;
    }

    /// Forgets the position but for a variance (m^2).
    #[inline(always)]
    pub(crate) fn let_go(&mut self, variance: f32) {
        self.diagonal[0] = variance;
        self.upper[..4].fill(0.0);
    }

    /// The innovation of `z` where `h` is 1 for the position, then the four numbers.
    #[inline(always)]
    pub(crate) fn prepare(&self, z: f32, h: [f32; STATES - 1], noise: f32) -> Prepared {
        let [_, d1, d2, d3, d4] = self.diagonal;
        let [u01, u02, u03, u04, u12, u13, u14, u23, u24, u34] = self.upper;
        let [h1, h2, h3, h4] = h;
        let f1 = h1 + u01;
        let f2 = h2 + (u02 + u12 * h1);
        let f3 = h3 + (u03 + u13 * h1 + u23 * h2);
        let f4 = h4 + (u04 + u14 * h1) + (u24 * h2 + u34 * h3);
        let [x0, x1, x2, x3, x4] = self.state;
        let innovation = (z - x0 - x3 * h3) - (x1 * h1 + x2 * h2) - x4 * h4;
        let told = (f1 * d1) * f1 + (f2 * d2) * f2 + (f3 * d3) * f3 + (f4 * d4) * f4;
        Prepared {
            projected: [1.0, f1, f2, f3, f4],
            innovation,
            noise,
            variance: noise + self.diagonal[0] + told,
            told,
        }
    }

    /// Takes a prepared measurement in.
    #[inline(always)]
    pub(crate) fn update(&mut self, prepared: &Prepared) {
        let f = prepared.projected;
        let g: [f32; STATES] = core::array::from_fn(|i| self.diagonal[i] * f[i]);
        let mut gain = [g[0], 0.0, 0.0, 0.0, 0.0];
        let mut alpha = prepared.noise + f[0] * g[0];
        let mut inverse = 1.0 / alpha;
        self.diagonal[0] *= prepared.noise * inverse;
        for column in 1..STATES {
            let before = alpha;
            let factor = f[column] * inverse;
            alpha += f[column] * g[column];
            inverse = 1.0 / alpha;
            self.diagonal[column] *= before * inverse;
            for (row, gain) in gain.iter_mut().enumerate().take(column) {
                let place = place(row, column);
                let u = self.upper[place];
                self.upper[place] = u - *gain * factor;
                *gain += g[column] * u;
            }
            gain[column] = g[column];
        }
        let scaled = prepared.innovation * inverse;
        for (state, gain) in self.state.iter_mut().zip(gain) {
            *state += gain * scaled;
        }
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
    [0, 3, 5, 6][row] + column - 1
}
