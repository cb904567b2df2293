//! Why a reference solution does not exist or was not reached.

use std::error::Error;

/// A law without a solution, a motion that is not one, or a tolerance that was not reached.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The reference has no law for this element.
    #[error("reference: no law for this element")]
    Element,
    /// The clearance is negative or not finite.
    #[error("reference: mount.clearance_m = {clearance_m} must be 0 or more")]
    Clearance {
        /// 2a (m).
        clearance_m: f64,
    },
    /// The force limit leaves no range of forces, or the mount no stiffness.
    #[error(
        "reference: the force limit {force_limit_n} N must be finite and above the {closed_force_n} N at \
         which the piston starts, over a mount stiffness above 0 (here {stiffness_n_per_m} N/m)"
    )]
    ForceLimit {
        /// Force at which the damper yields (N).
        force_limit_n: f64,
        /// Force up to which the piston stands still (N).
        closed_force_n: f64,
        /// Mount springs in series (N/m).
        stiffness_n_per_m: f64,
    },
    /// Nothing flows at the force limit.
    #[error(
        "reference: piston velocity {velocity_m_per_s} m/s at the force limit {force_limit_n} N must be \
         above 0: a flow path has no width or the oil no density"
    )]
    NoFlow {
        /// Piston velocity at the force limit (m/s).
        velocity_m_per_s: f64,
        /// Force at which the damper yields (N).
        force_limit_n: f64,
    },
    /// Not one displacement for each time.
    #[error(
        "reference: {times} times and {displacements} displacements; one displacement per time, at least one"
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
        /// Its index.
        sample: usize,
        /// Its time (s).
        time_s: f64,
        /// Its displacement (m).
        displacement_m: f64,
    },
    /// Times do not increase.
    #[error("reference: times must increase; sample {sample} at {time_s} s follows {before_s} s")]
    Times {
        /// Index of the later sample.
        sample: usize,
        /// Its time (s).
        time_s: f64,
        /// The time before it (s).
        before_s: f64,
    },
    /// Contact changes without end within one linear piece of the motion.
    #[error(
        "reference: more than {most} changes of contact in one piece of motion from {start_m} m to {end_m} m"
    )]
    Changes {
        /// Changes allowed.
        most: usize,
        /// Displacement at the start of the piece (m).
        start_m: f64,
        /// Displacement at its end (m).
        end_m: f64,
    },
    /// The solver of differential equations gave up.
    #[error("reference solver: {source}{place}")]
    Solver {
        /// Where, for a person; empty while the solver was set up.
        place: String,
        /// Its own reason.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The solver stopped without having met an event.
    #[error("reference solver: stopped without an event")]
    NoEvent,
    /// A failure, and the piece of the motion it happened in.
    #[error("{source}, between {start_s} s and {end_s} s")]
    Piece {
        /// Start of the piece (s).
        start_s: f64,
        /// End of the piece (s).
        end_s: f64,
        /// What failed.
        source: Box<ReferenceError>,
    },
    /// Nobody wants the solution any more.
    #[error("reference: ended before its end, as was asked")]
    Unwanted,
    /// A rolling contact that has no solution.
    #[error(
        "reference: a/b {a_over_b} must be above 0, Poisson's ratio {poisson_ratio} within 0 to 0.5, and the mesh \
         {along} x {strips} not empty"
    )]
    RollingContact {
        /// Semi-axis in the rolling direction over that across.
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
        "reference: the tractions at the creepages {creepage:?} over mu N / (G a b) do not converge"
    )]
    RollingDiverges {
        /// Longitudinal, lateral and spin creepage, scaled.
        creepage: [f64; 3],
    },
    /// The law of an element is not known to the reference.
    #[error("reference: {element}: the law of this element is not supported")]
    UnknownLaw {
        /// Name of the element.
        element: String,
    },
    /// A vehicle that cannot stand or run, or a number out of bounds.
    #[error("reference: {0}")]
    Vehicle(#[from] dashpot_rail::vehicle::VehicleError),
}
