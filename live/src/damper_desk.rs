//! A damper on the desk: its parameters as new and now, its fault, its wear.

use std::collections::BTreeMap;

use dashpot_core::{CheckedParameters, DamperParameters};
use dashpot_files::damper::{self, DamperError, KeyedParameters, PRESETS};
use serde::Serialize;

use crate::error::within;
use crate::fault::{FAULTS, FaultKind};
use crate::quantity::{self, Quantity, WEAR, worn};
use crate::unknown_name::UnknownName;
use crate::{Action, ActionError};

/// A damper that an operator changes.
#[derive(Debug, Clone)]
pub struct DamperDesk {
    name: String,
    as_new: KeyedParameters,
    /// As new, or the preset in its place; the sliders have their ranges around it.
    usual: KeyedParameters,
    now: KeyedParameters,
    fault: Option<&'static str>,
    wear: f64,
    is_changed: bool,
}

/// State of a damper in a status.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamperStatus {
    values: BTreeMap<&'static str, f64>,
    quantities: Vec<Quantity>,
    changed: bool,
    fault: Option<&'static str>,
}

impl DamperDesk {
    /// A damper as new.
    ///
    /// # Errors
    /// It cannot be written as a file.
    pub fn new(name: &str, parameters: &DamperParameters) -> Result<Self, DamperError> {
        let as_new = KeyedParameters::new(name, parameters)?;
        Ok(Self {
            name: name.to_owned(),
            now: as_new.clone(),
            usual: as_new.clone(),
            as_new,
            fault: None,
            wear: 0.0,
            is_changed: false,
        })
    }

    /// Name of the damper.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Present parameters.
    ///
    /// # Errors
    /// None are known: an action that gives forbidden parameters is refused.
    pub fn parameters(&self) -> Result<CheckedParameters, DamperError> {
        self.now.with(&[])
    }

    /// Parameters as new.
    ///
    /// # Errors
    /// None are known: the damper was built from them.
    pub fn parameters_as_new(&self) -> Result<CheckedParameters, DamperError> {
        self.as_new.with(&[])
    }

    /// True if it differs from itself as new.
    pub fn is_changed(&self) -> bool {
        self.is_changed
    }

    /// Numbers that an operator changes, as new.
    pub fn quantities(&self) -> Vec<Quantity> {
        quantity::of_damper(&self.as_new)
    }

    /// State for a page.
    pub fn status(&self) -> DamperStatus {
        let quantities = quantity::of_damper(&self.usual);
        let numbers = quantities.iter().map(|quantity| match quantity.key {
            WEAR => (WEAR, self.wear),
            key => (key, self.now.number(key).unwrap_or(quantity.value)),
        });
        DamperStatus {
            values: numbers.collect(),
            quantities,
            changed: self.is_changed,
            fault: self.fault,
        }
    }

    /// The damper after an action on it.
    ///
    /// # Errors
    /// Unknown names, values that are not allowed, or the action is not one on a damper.
    pub fn after(&self, action: &Action) -> Result<Self, ActionError> {
        match action {
            Action::Damper { key, value, .. } if key == WEAR => {
                within(WEAR, *value, [0.0, 1.0])?;
                let worn = self.new_but(&worn(&self.as_new, *value))?;
                Ok(Self {
                    wear: *value,
                    ..worn
                })
            }
            Action::Damper { key, value, .. } => self.with(&*self.now.with(&[(key, *value)])?),
            Action::Preset { preset, .. } => {
                let names = || PRESETS.iter().map(|(name, _)| *name);
                if !names().any(|name| name == preset) {
                    return Err(UnknownName::new("preset", preset, names()).into());
                }
                let loaded = self.with(&*damper::load(preset, &[])?)?;
                Ok(Self {
                    usual: loaded.now.clone(),
                    fault: None,
                    wear: 0.0,
                    ..loaded
                })
            }
            Action::AsNew { .. } => {
                let as_new = self.new_but(&[])?;
                Ok(Self {
                    is_changed: false,
                    ..as_new
                })
            }
            Action::Fault { fault, .. } => {
                let names = || FAULTS.iter().map(|fault| fault.id);
                let found = FaultKind::find(fault);
                let found = found.ok_or_else(|| UnknownName::new("fault", fault, names()))?;
                let faulty = self.new_but(&found.changes(&self.as_new))?;
                Ok(Self {
                    fault: Some(found.id),
                    ..faulty
                })
            }
            _ => Err(ActionError::Message("not an action on a damper".into())),
        }
    }

    /// As new but for these numbers, without fault and wear.
    fn new_but(&self, numbers: &[(&str, f64)]) -> Result<Self, ActionError> {
        let changed = self.with(&*self.as_new.with(numbers)?)?;
        Ok(Self {
            usual: self.as_new.clone(),
            fault: None,
            wear: 0.0,
            ..changed
        })
    }

    fn with(&self, parameters: &DamperParameters) -> Result<Self, ActionError> {
        Ok(Self {
            now: KeyedParameters::new(&self.name, parameters)?,
            is_changed: true,
            ..self.clone()
        })
    }
}
