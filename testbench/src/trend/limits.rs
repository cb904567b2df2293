//! Limits beyond which a damper should be taken out of service, from docs/out-of-service.md and docs/health.md.

/// Where a damper works in the vehicle, which decides its limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Vertical damper; its wear is felt in the ride.
    #[default]
    Vertical,
    /// Lateral damper; its wear loads the wheels.
    Lateral,
    /// Yaw damper; its wear permits hunting.
    Yaw,
}

/// Limits of one damper; `None` where none is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Lowest damping, relative to nominal (1).
    pub damping_factor: Option<f64>,
    /// Lowest effective stiffness Ke (N/m).
    pub stiffness_n_per_m: Option<f64>,
    /// Highest clearance 2a (m).
    pub clearance_m: Option<f64>,
}

/// Damping factor at which the health estimator raises its alarm: 15 % more flow than nominal. The studies of worn
/// dampers contain no limit of the damping.
const DAMPING_FACTOR: f64 = 1.0 / 1.15;

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Vertical, Self::Lateral, Self::Yaw];

    /// Returns the name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vertical => "vertical",
            Self::Lateral => "lateral",
            Self::Yaw => "yaw",
        }
    }

    /// Returns the kind that the name of a damper contains as a word, such as `front-lateral-1`; vertical without one.
    pub fn in_name(damper: &str) -> Self {
        let name = damper.to_lowercase();
        let mut words = name.split(|c: char| !c.is_alphanumeric());
        let found = words.find_map(|word| Self::ALL.into_iter().find(|kind| kind.name() == word));
        found.unwrap_or_default()
    }

    /// Returns the limits if all dampers of this kind are worn alike (docs/out-of-service.md).
    ///
    /// - Vertical: the ride is 5 % worse.
    /// - Lateral: the ride is 5 % worse below this stiffness; no clearance reaches that.
    /// - Yaw: the play, or the softness of the ends, with which the lateral force exceeds its limit in some runs.
    pub fn limits(self) -> Limits {
        let (clearance_m, stiffness_n_per_m) = match self {
            Self::Vertical => (Some(2.9e-3), 2.1e6),
            Self::Lateral => (None, 1.1e6),
            Self::Yaw => (Some(2e-3), 4e6),
        };
        Limits {
            damping_factor: Some(DAMPING_FACTOR),
            stiffness_n_per_m: Some(stiffness_n_per_m),
            clearance_m,
        }
    }
}

impl Limits {
    /// Returns these limits where they are given, and those of `other` elsewhere.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            damping_factor: self.damping_factor.or(other.damping_factor),
            stiffness_n_per_m: self.stiffness_n_per_m.or(other.stiffness_n_per_m),
            clearance_m: self.clearance_m.or(other.clearance_m),
        }
    }
}
