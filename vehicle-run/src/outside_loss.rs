//! Loss of external dampers during a run.

use std::fmt;

/// External dampers that stopped delivering forces.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct OutsideLoss {
    /// The link to the dampers, and why it was lost.
    pub message: String,
    /// The dampers behind the link.
    pub dampers: Vec<LostDamper>,
    /// Time of the first displacement without a valid answer, s.
    pub silent_since_s: f64,
    /// Number of valid answers that are missing since then.
    pub missing_answers: u64,
}

/// An external damper that was lost.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct LostDamper {
    /// Name of the damper.
    pub damper: String,
    /// Force of the last valid answer, which the vehicle used until the end, N; 0 before the first answer.
    pub held_force_n: f64,
}

impl LostDamper {
    /// Creates a lost damper with the force (N) of its last valid answer.
    pub fn new(damper: impl Into<String>, held_force_n: f64) -> Self {
        Self {
            damper: damper.into(),
            held_force_n,
        }
    }
}

impl OutsideLoss {
    /// Creates a loss from its reason, the dampers, the time of the first displacement without a valid answer (s), and
    /// the number of missing answers.
    ///
    /// ```
    /// use dashpot_vehicle_run::{LostDamper, OutsideLoss};
    /// let dampers = vec![LostDamper::new("front damper", -812.34)];
    /// let loss = OutsideLoss::new("tcp:rig:5555: no answer", dampers, 0.25, 101);
    /// assert_eq!(
    ///     loss.to_string(),
    ///     "tcp:rig:5555: no answer; no valid answer since 0.250 s, 101 missing; last force, held until the end: \
    ///      front damper -812.3 N"
    /// );
    /// ```
    pub fn new(
        message: impl Into<String>,
        dampers: Vec<LostDamper>,
        silent_since_s: f64,
        missing_answers: u64,
    ) -> Self {
        Self {
            message: message.into(),
            dampers,
            silent_since_s,
            missing_answers,
        }
    }
}

impl fmt::Display for OutsideLoss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let forces = self.dampers.iter();
        let forces = forces.map(|lost| format!("{} {:.1} N", lost.damper, lost.held_force_n));
        write!(
            f,
            "{}; no valid answer since {:.3} s, {} missing; last force, held until the end: {}",
            self.message,
            self.silent_since_s,
            self.missing_answers,
            forces.collect::<Vec<_>>().join(", ")
        )
    }
}
