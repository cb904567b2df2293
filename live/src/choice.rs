//! Choice of a case by names and numbers, short enough for a link.

use dashpot_files::case::{CASES, Case, CaseError, CaseOptions};
use dashpot_files::track::{IrregularityParameters, TRACKS};
use dashpot_files::vehicle::VEHICLES;
use serde::{Deserialize, Serialize};

use crate::unknown_name::UnknownName;

/// Shortest length of generated irregularities in a browser, m: a minute at 180 km/h, computed in half a second.
const LENGTH_M: f64 = 3000.0;

/// A shipped case with some of its parts replaced.
///
/// ```
/// use dashpot_live::Choice;
/// let choice = Choice { speed_km_h: Some(160.0), ..Choice::of("straight-180") };
/// let case = choice.case()?;
/// assert_eq!(case.speed_m_per_s, 160.0 / 3.6);
/// # Ok::<(), dashpot_live::ChoiceError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Choice {
    /// Shipped case.
    pub case: String,
    /// Shipped vehicle in place of the case's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<String>,
    /// Shipped track in place of the case's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub track: Option<String>,
    /// Speed, km/h.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_km_h: Option<f64>,
    /// Static friction coefficient between wheel and rail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Seed of the track's irregularities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Overrides, `part.key=value`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
}

/// Error of a choice.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChoiceError {
    /// Only shipped files can be chosen.
    #[error(transparent)]
    NotShipped(#[from] UnknownName),
    /// The irregularities of the track are not generated.
    #[error("seed {0}: the irregularities of this track are not generated; allowed: no seed")]
    Seed(u64),
    /// The case cannot be built.
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
}

fn shipped(kind: &'static str, name: &str, names: &[(&str, &str)]) -> Result<(), UnknownName> {
    let known = names.iter().map(|(known, _)| *known);
    match known.clone().any(|known| known == name) {
        true => Ok(()),
        false => Err(UnknownName::new(kind, name, known)),
    }
}

impl Choice {
    /// A case as it ships.
    pub fn of(case: &str) -> Self {
        Self {
            case: case.to_owned(),
            ..Self::default()
        }
    }

    /// Builds the case. Its track is that of [`endless`].
    ///
    /// # Errors
    /// A name that does not ship, a number out of bounds, or an override that does not apply.
    pub fn case(&self) -> Result<Case, ChoiceError> {
        shipped("shipped case", &self.case, &CASES)?;
        if let Some(vehicle) = &self.vehicle {
            shipped("shipped vehicle", vehicle, &VEHICLES)?;
        }
        if let Some(track) = &self.track {
            shipped("shipped track", track, &TRACKS)?;
        }
        let case = self.options().and_then(|options| options.case());
        let mut case = case.map_err(Box::new)?;
        if let Some(seed) = self.seed {
            case.track = case.track.with_seed(seed).ok_or(ChoiceError::Seed(seed))?;
        }
        Ok(endless(case, LENGTH_M))
    }

    fn options(&self) -> Result<CaseOptions, CaseError> {
        let mut options = CaseOptions::load(&self.case)?;
        if let Some(vehicle) = &self.vehicle {
            options.set_vehicle(vehicle);
        }
        if let Some(track) = &self.track {
            options.set_track(track);
        }
        for (key, number) in [("speed_km_h", self.speed_km_h), ("friction", self.friction)] {
            if let Some(number) = number {
                options.set_number(key, number);
            }
        }
        options.overrides.extend(self.set.iter().cloned());
        Ok(options)
    }
}

/// Prepares a case for a run whose end nobody knows: no duration, and generated irregularities of at least this length
/// (m). Longer irregularities have the same spectrum, but other values.
pub fn endless(mut case: Case, irregular_m: f64) -> Case {
    case.duration_s = 1e9;
    if let IrregularityParameters::Generated { generation, .. } = &mut case.track.irregularity {
        generation.length_m = generation.length_m.max(irregular_m);
    }
    case
}
