//! Actions of an operator, as the page sends them.

use serde::{Deserialize, Serialize};

/// Something that an operator does to the running vehicle.
///
/// ```
/// use dashpot_live::Action;
/// let action: Action = serde_json::from_str(r#"{"action": "speed", "speed_km_h": 160}"#)?;
/// assert_eq!(action, Action::Speed { speed_km_h: 160.0 });
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "action", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Action {
    /// Changes a number of a damper.
    Damper {
        /// Name of the damper.
        damper: String,
        /// Key of the number, such as `mount.clearance_m`.
        key: String,
        /// Its new value, in the unit of the key.
        value: f64,
    },
    /// Replaces a damper by a preset.
    Preset {
        /// Name of the damper.
        damper: String,
        /// Name of the preset.
        preset: String,
    },
    /// Gives a damper the parameters of its case.
    AsNew {
        /// Name of the damper.
        damper: String,
    },
    /// Gives a damper a fault.
    Fault {
        /// Name of the damper.
        damper: String,
        /// Identifier of the fault, see [`FAULTS`](crate::FAULTS).
        fault: String,
    },
    /// Changes the speed, at 1 m/s^2.
    Speed {
        /// New speed, km/h.
        speed_km_h: f64,
    },
    /// Changes the friction of all wheels, within a fifth of a second.
    Friction {
        /// Factor on the friction coefficients of the case.
        factor: f64,
    },
    /// Puts a defect on the track ahead of the leading wheelset.
    Defect {
        /// Kind, see [`DEFECTS`](crate::DEFECTS).
        kind: String,
        /// Size in the unit of the kind.
        size: f64,
    },
    /// A gust from the left pushes the first body to the right: it rises and falls like a cosine.
    Gust {
        /// Greatest force, N; negative from the right.
        force_n: f64,
        /// Duration, s.
        duration_s: f64,
    },
}

impl Action {
    /// Name of the damper that the action changes, if it changes one.
    pub fn damper(&self) -> Option<&str> {
        match self {
            Self::Damper { damper, .. }
            | Self::Preset { damper, .. }
            | Self::AsNew { damper }
            | Self::Fault { damper, .. } => Some(damper),
            Self::Speed { .. }
            | Self::Friction { .. }
            | Self::Defect { .. }
            | Self::Gust { .. } => None,
        }
    }
}
