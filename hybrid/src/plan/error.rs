//! Errors of the delay that a damper position bears.

/// Errors of a plant without damper and of its loop.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The matrix and the vectors of the plant do not fit each other.
    #[error(
        "plant: matrix of {rows} x {columns}, input of {inputs} and output of {outputs}, allowed: a square matrix of \
         at least one row, and as many values of input and output"
    )]
    Shape {
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
        /// Length of the input vector.
        inputs: usize,
        /// Length of the output vector.
        outputs: usize,
    },
    /// A value of the plant is not finite.
    #[error("plant: {name} has a value that is not finite, allowed: finite values")]
    NotFinite {
        /// Matrix or vector.
        name: &'static str,
    },
    /// A parameter of the damper is out of bounds.
    #[error("damper: {name} = {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the parameter, with its unit.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and largest allowed value.
        allowed: [f64; 2],
    },
    /// The eigenvalue iteration did not converge. No such plant is known.
    #[error("plant with damper: its eigenvalues were not found")]
    NoEigenvalues,
    /// The vehicle is unstable with this damper and without any delay.
    #[error(
        "vehicle with the damper and no delay: unstable at {frequency_hz:.4} Hz (growth {growth_per_s:.3e} 1/s), \
         allowed: a vehicle that is stable without delay"
    )]
    UnstableWithoutDelay {
        /// Frequency of the fastest growing motion, Hz; zero if it does not oscillate.
        frequency_hz: f64,
        /// Real part of its eigenvalue, 1/s.
        growth_per_s: f64,
    },
    /// A motion of the vehicle with this damper and without delay is undamped to within rounding.
    #[error(
        "vehicle with the damper and no delay: motion at {frequency_hz:.4} Hz is undamped, so its stability cannot be \
         decided, allowed: damping of all motion, and a spring on each coordinate"
    )]
    Undamped {
        /// Frequency of the motion, Hz; zero for a coordinate that nothing holds.
        frequency_hz: f64,
    },
    /// The loop factor has no finite value at a frequency.
    #[error(
        "loop factor: not finite at {frequency_hz:.4e} Hz, allowed: a stable factor, finite above 0 Hz"
    )]
    LoopFactor {
        /// Frequency, Hz.
        frequency_hz: f64,
    },
    /// The loop factor grows so fast with frequency that the loop does not decay.
    #[error(
        "loop factor: magnitude {magnitude:.3e} at {frequency_hz:.4e} Hz, allowed there: less than {allowed:.3e}, so \
         that the loop decays with frequency"
    )]
    LoopFactorGrows {
        /// Frequency, Hz.
        frequency_hz: f64,
        /// Magnitude of the factor.
        magnitude: f64,
        /// Smallest magnitude that is refused.
        allowed: f64,
    },
    /// The loop factor varies too fast with frequency.
    #[error(
        "loop factor: it varies too fast with frequency at {frequency_hz:.4e} Hz; is a delay in seconds?"
    )]
    LoopFactorVaries {
        /// Frequency, Hz.
        frequency_hz: f64,
    },
    /// The loop factor still varies at the lowest frequency of the sweep.
    #[error(
        "loop factor: it makes the loop vary below {frequency_hz:.4e} Hz, allowed: a loop that is constant at lower \
         frequencies"
    )]
    Slow {
        /// Lowest frequency of the sweep, Hz.
        frequency_hz: f64,
    },
    /// A root of the closed loop is on the imaginary axis to within rounding.
    #[error(
        "loop: a root is at {frequency_hz:.6} Hz on the stability limit to within rounding; vary a parameter slightly"
    )]
    OnLimit {
        /// Frequency of the root, Hz.
        frequency_hz: f64,
    },
    /// The magnitude of the loop touches 1 to within rounding, so it is undecided whether a delay is critical.
    #[error(
        "loop: its magnitude touches 1 at {frequency_hz:.6} Hz to within rounding, so it is undecided whether a delay \
         of {delay_s:.3e} s is critical; vary a parameter slightly"
    )]
    Touches {
        /// Frequency, Hz.
        frequency_hz: f64,
        /// Delay at which a root would be on the stability limit, s.
        delay_s: f64,
    },
    /// The turns of the loop about zero are not a possible count of roots.
    #[error(
        "loop: {count:.3} unstable roots by its turns, allowed: a whole number; is the factor stable, and real at 0 Hz?"
    )]
    NoCount {
        /// Count of unstable roots.
        count: f64,
    },
    /// The loop needs more samples than allowed.
    #[error(
        "loop: not resolved with {samples} samples up to {frequency_hz:.4e} Hz; its factor varies too fast"
    )]
    TooFine {
        /// Samples taken.
        samples: usize,
        /// Frequency reached, Hz.
        frequency_hz: f64,
    },
}
