//! Translates a user's request into the parameters of a calibration.

use super::keys::{DISPLACEMENT_OFFSET, RIG, SKEW};
use super::loops::LoopTest;
use super::prior::Prior;
use super::rig::{HeldRig, is_rig_parameter};
use super::varied::Varied;
use super::{CalibrationError, plausible};
use dashpot_files::damper::KeyedParameters;

/// Returns the key of a parameter that belongs to one test alone.
fn own_key(key: &str, test: usize) -> String {
    format!("{key}@{test}")
}

/// A user's request: parameters to vary, priors and rig parameters to hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// Parameters to vary, with optional bounds. Rig parameters vary whether or not they are listed.
    pub vary: Vec<(String, Option<[f64; 2]>)>,
    /// Parameters to vary for each test on its own, with optional bounds.
    pub vary_each: Vec<(String, Option<[f64; 2]>)>,
    /// Priors by key.
    pub priors: Vec<(String, Prior)>,
    /// Rig parameters to hold, by default at zero.
    pub hold: Vec<(String, Option<f64>)>,
    /// True to ignore the default priors.
    pub only_own_priors: bool,
}

impl Request {
    /// Checks everything that can be checked before a recording is read.
    ///
    /// # Errors
    /// Same errors as [`Request::varied`].
    pub fn check(&self, damper: &KeyedParameters) -> Result<(), CalibrationError> {
        self.check_names()?;
        self.damper_parameters(damper)?;
        self.own_parameters(damper, 1)?;
        Ok(())
    }

    /// Returns the parameters that vary for `damper` and `loops`, and the values of the other rig parameters.
    ///
    /// # Errors
    /// Returns an error for a parameter that does not exist, cannot be calibrated or is given twice, for bounds that
    /// are not in order, for a prior of a parameter that does not vary, or for a rig parameter without recorded loops.
    pub fn varied(
        &self,
        damper: &KeyedParameters,
        loops: &[LoopTest],
    ) -> Result<(Vec<Varied>, HeldRig), CalibrationError> {
        self.check_names()?;
        let mut varied = self.damper_parameters(damper)?;
        varied.extend(self.own_parameters(damper, loops.len())?);
        let mut rig = HeldRig::default();
        for (key, value) in &self.hold {
            let held = if key == SKEW {
                &mut rig.skew_s
            } else {
                &mut rig.force_offset_n
            };
            *held = value.unwrap_or(0.0);
        }
        for (key, bounds) in &self.vary_each {
            let tests = if is_rig_parameter(key) {
                loops.len()
            } else {
                0
            };
            for test in 1..=tests {
                let own = own_key(key, test);
                varied.push(Varied::rig(&own, loops, *bounds, self.prior(key))?);
            }
        }
        let is_own = |key: &str| self.vary_each.iter().any(|(each, _)| each == key);
        for key in RIG.into_iter().filter(|key| !is_own(key)) {
            let named = self.vary.iter().find(|(varied, _)| varied == key);
            if loops.is_empty() {
                let is_named = named.is_some() || self.prior(key).is_some();
                if is_named || self.hold.iter().any(|(held, _)| held == key) {
                    return Err(CalibrationError::NoLoops { key: key.into() });
                }
                continue;
            }
            // A calibration needs at least one damper parameter.
            if varied.iter().all(Varied::is_rig_parameter)
                || self.hold.iter().any(|(held, _)| held == key)
            {
                continue;
            }
            let bounds = named.and_then(|(_, bounds)| *bounds);
            varied.push(Varied::rig(key, loops, bounds, self.prior(key))?);
        }
        Ok((varied, rig))
    }

    /// Returns the damper parameters that vary.
    fn damper_parameters(&self, damper: &KeyedParameters) -> Result<Vec<Varied>, CalibrationError> {
        let named = self.vary.iter().filter(|(key, _)| !is_rig_parameter(key));
        let varied = named.map(|(key, bounds)| {
            let prior = self.prior(key);
            let mut varied = Varied::new(damper, key, *bounds, prior)?;
            if self.only_own_priors {
                varied.prior = prior;
            }
            Ok(varied)
        });
        varied.collect()
    }

    /// Returns the damper parameters that each test has for itself.
    fn own_parameters(
        &self,
        damper: &KeyedParameters,
        tests: usize,
    ) -> Result<Vec<Varied>, CalibrationError> {
        let each = self
            .vary_each
            .iter()
            .filter(|(key, _)| !is_rig_parameter(key));
        let own = each.flat_map(|(key, bounds)| {
            (1..=tests)
                .map(move |test| Varied::new(damper, &own_key(key, test), *bounds, self.prior(key)))
        });
        own.collect()
    }

    fn prior(&self, key: &str) -> Option<Prior> {
        let mut given = self.priors.iter().filter(|(name, _)| name == key);
        given.next().map(|(_, prior)| *prior)
    }

    fn check_names(&self) -> Result<(), CalibrationError> {
        let check_unique = |named: &[&str]| -> Result<(), CalibrationError> {
            for (parameter, key) in named.iter().enumerate() {
                let key = (*key).to_owned();
                if key == DISPLACEMENT_OFFSET {
                    return Err(CalibrationError::NoForceDepends { key });
                }
                if named[..parameter].contains(&key.as_str()) {
                    return Err(CalibrationError::Twice { key });
                }
            }
            Ok(())
        };
        let [vary, priors, hold] = [
            self.vary
                .iter()
                .chain(&self.vary_each)
                .map(|(key, _)| key.as_str())
                .collect::<Vec<_>>(),
            self.priors.iter().map(|(key, _)| key.as_str()).collect(),
            self.hold.iter().map(|(key, _)| key.as_str()).collect(),
        ];
        [&vary, &priors, &hold]
            .into_iter()
            .try_for_each(|named| check_unique(named))?;
        for (key, value) in &self.hold {
            if !is_rig_parameter(key) {
                return Err(CalibrationError::NotOfRig { key: key.clone() });
            }
            if vary.contains(&key.as_str()) || priors.contains(&key.as_str()) {
                return Err(CalibrationError::HeldAndVaried { key: key.clone() });
            }
            let max = super::rig::max_magnitude(key);
            if let Some(value) = value.filter(|value| !(-max..=max).contains(value)) {
                let key = key.clone();
                return Err(CalibrationError::Held { key, value, max });
            }
        }
        for key in priors {
            if !vary.contains(&key) && !is_rig_parameter(key) {
                let is_known = key
                    .rsplit_once('.')
                    .is_some_and(|(table, last)| plausible::plausible(table, last).is_some());
                let key = key.to_owned();
                return Err(CalibrationError::PriorOfHeld { key, is_known });
            }
        }
        Ok(())
    }
}
