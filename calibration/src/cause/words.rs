//! Causes in words.

use std::fmt;

use super::{Cause, CauseKind};

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value;
        match self.kind {
            CauseKind::AsNew => write!(f, "the damper is as new"),
            CauseKind::Flow => write!(
                f,
                "flow {value:.2} times that of the new damper: valves, or oil temperature"
            ),
            CauseKind::Stiffness => write!(
                f,
                "stiffness {:.2} MN/m: mount, or air in the oil",
                value * 1e-6
            ),
            CauseKind::Clearance => write!(f, "clearance {:.2} mm", value * 1e3),
            CauseKind::ForceScale => write!(f, "the force sensor reads {value:.2} times the force"),
            CauseKind::DisplacementScale => {
                write!(
                    f,
                    "the displacement sensor reads {value:.2} times the displacement"
                )
            }
            CauseKind::ForceZero => write!(f, "the force sensor reads {value:.0} N at zero force"),
            CauseKind::Lag => write!(
                f,
                "the force is {:.1} ms later than the displacement",
                value * 1e3
            ),
            CauseKind::Reversed => write!(f, "the force or the displacement has the wrong sign"),
            CauseKind::ForceHeld => {
                write!(
                    f,
                    "the force is stuck or drops out in {:.1} % of the samples",
                    value * 100.0
                )
            }
            CauseKind::DisplacementHeld => {
                write!(
                    f,
                    "the displacement is stuck or drops out in {:.1} % of the samples",
                    value * 100.0
                )
            }
        }
    }
}
