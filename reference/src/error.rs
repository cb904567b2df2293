//! Errors of the reference solvers.

use std::error::Error;

/// Invalid laws, motions or vehicles, and tolerances that were not reached.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The reference has no law for this element.
    #[error("reference: no law for this element")]
    Element,
    /// The clearance is negative or not finite.
    #[error("reference: mount.clearance_m = {clearance_m} must be 0 or more")]
    Clearance {
        /// Clearance (m).
        clearance_m: f64,
    },
    /// The force limit is not above the closed force, or the mount has no stiffness.
    #[error(
        "reference: the force limit {force_limit_n} N must be finite and above the {closed_force_n} N at \
         which the piston starts, and the mount stiffness {stiffness_n_per_m} N/m must be above 0"
    )]
    ForceLimit {
        /// Force at which the damper yields (N).
        force_limit_n: f64,
        /// Force up to which the piston does not move (N).
        closed_force_n: f64,
        /// Mount springs in series (N/m).
        stiffness_n_per_m: f64,
    },
    /// No oil flows at the force limit.
    #[error(
        "reference: piston velocity {velocity_m_per_s} m/s at the force limit {force_limit_n} N must be \
         above 0: a flow path has no width, or the oil has no density"
    )]
    NoFlow {
        /// Piston velocity at the force limit (m/s).
        velocity_m_per_s: f64,
        /// Force at which the damper yields (N).
        force_limit_n: f64,
    },
    /// The numbers of times and displacements differ, or both are zero.
    #[error(
        "reference: {times} times and {displacements} displacements; give one displacement per time, at least one"
    )]
    Lengths {
        /// Number of times.
        times: usize,
        /// Number of displacements.
        displacements: usize,
    },
    /// A sample is not finite.
    #[error(
        "reference: sample {sample} (time {time_s} s, displacement {displacement_m} m) must be finite"
    )]
    Sample {
        /// Index of the sample.
        sample: usize,
        /// Time of the sample (s).
        time_s: f64,
        /// Displacement of the sample (m).
        displacement_m: f64,
    },
    /// The times do not increase.
    #[error("reference: times must increase; sample {sample} at {time_s} s follows {before_s} s")]
    Times {
        /// Index of the later sample.
        sample: usize,
        /// Time of the later sample (s).
        time_s: f64,
        /// Time of the earlier sample (s).
        before_s: f64,
    },
    /// The contact changes too often within one linear piece of the motion.
    #[error(
        "reference: more than {max} changes of contact in one piece of motion from {start_m} m to {end_m} m"
    )]
    Changes {
        /// Maximum number of changes.
        max: usize,
        /// Displacement at the start of the piece (m).
        start_m: f64,
        /// Displacement at its end (m).
        end_m: f64,
    },
    /// The differential-equation solver failed.
    #[error("reference solver: {source}{place}")]
    Solver {
        /// Description of the point of failure; may be empty.
        place: String,
        /// Error of the solver.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The solver stopped before an event.
    #[error("reference solver: stopped without an event")]
    NoEvent,
    /// An error within one piece of the motion.
    #[error("{source}, between {start_s} s and {end_s} s")]
    Piece {
        /// Start of the piece (s).
        start_s: f64,
        /// End of the piece (s).
        end_s: f64,
        /// The error within the piece.
        source: Box<ReferenceError>,
    },
    /// The caller cancelled the solution.
    #[error("reference: cancelled")]
    Cancelled,
    /// Invalid parameters of a rolling contact.
    #[error(
        "reference: a/b {a_over_b} must be above 0, Poisson's ratio {poisson_ratio} within 0 to 0.5, and the mesh \
         {along} x {strips} not empty"
    )]
    RollingContact {
        /// Semi-axis in the rolling direction over the lateral semi-axis.
        a_over_b: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
        /// Elements along each strip.
        along: usize,
        /// Number of strips.
        strips: usize,
    },
    /// The tractions of a rolling contact do not converge.
    #[error(
        "reference: the tractions do not converge at the creepages {creepage:?}, divided by mu N / (G a b)"
    )]
    RollingDiverges {
        /// Scaled longitudinal, lateral and spin creepage.
        creepage: [f64; 3],
    },
    /// The reference does not know the law of an element.
    #[error("reference: {element}: the law of this element is not supported")]
    UnknownLaw {
        /// Name of the element.
        element: String,
    },
    /// A vehicle without equilibrium, or a value out of bounds.
    #[error("reference: {0}")]
    Vehicle(#[from] dashpot_rail::vehicle::VehicleError),
}
