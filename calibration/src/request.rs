//! What a user asks to vary, to hold and what is known before, as the numbers of a calibration.

use super::loops::LoopTest;
use super::rig::{DISPLACEMENT_OFFSET, HeldRig, RIG, SKEW, is_of_rig};
use super::varied::{Prior, Varied};
use super::{CalibrationError, plausible};
use dashpot_files::damper::Keyed;

/// What a user asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// Numbers to vary, with bounds where the user has some. The rig's numbers vary with or without being named.
    pub vary: Vec<(String, Option<[f64; 2]>)>,
    /// What is known of numbers before.
    pub priors: Vec<(String, Prior)>,
    /// Numbers of the rig that are held, at zero where no value is given.
    pub hold: Vec<(String, Option<f64>)>,
    /// Leave out the priors that hold for every damper.
    pub only_own_priors: bool,
}

impl Request {
    /// Checks what can be checked before a recording is read.
    ///
    /// # Errors
    /// As [`Request::varied`].
    pub fn check(&self, damper: &Keyed) -> Result<(), CalibrationError> {
        self.check_names()?;
        self.of_damper(damper).map(|_| ())
    }

    /// The numbers that vary in a calibration of `damper` from `loops`, and the values of the rig's numbers that do not.
    ///
    /// # Errors
    /// A number that does not exist or that forces do not determine, one that is named twice, bounds that are not in order, a prior of a
    /// number that does not vary, or a number of the rig without a recorded loop.
    pub fn varied(
        &self,
        damper: &Keyed,
        loops: &[LoopTest],
    ) -> Result<(Vec<Varied>, HeldRig), CalibrationError> {
        self.check_names()?;
        let mut varied = self.of_damper(damper)?;
        let mut rig = HeldRig::default();
        for (key, value) in &self.hold {
            let held = if key == SKEW {
                &mut rig.skew_s
            } else {
                &mut rig.force_offset_n
            };
            *held = value.unwrap_or(0.0);
        }
        for key in RIG {
            let named = self.vary.iter().find(|(varied, _)| varied == key);
            if loops.is_empty() {
                let is_named = named.is_some() || self.prior(key).is_some();
                if is_named || self.hold.iter().any(|(held, _)| held == key) {
                    return Err(CalibrationError::NoLoops { key: key.into() });
                }
                continue;
            }
            // The rig's numbers alone are no calibration of a damper.
            if varied.iter().all(Varied::is_of_rig) || self.hold.iter().any(|(held, _)| held == key)
            {
                continue;
            }
            let bounds = named.and_then(|(_, bounds)| *bounds);
            varied.push(Varied::of_rig(key, loops, bounds, self.prior(key))?);
        }
        Ok((varied, rig))
    }

    /// The damper's numbers.
    fn of_damper(&self, damper: &Keyed) -> Result<Vec<Varied>, CalibrationError> {
        let named = self.vary.iter().filter(|(key, _)| !is_of_rig(key));
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

    fn prior(&self, key: &str) -> Option<Prior> {
        let mut given = self.priors.iter().filter(|(of, _)| of == key);
        given.next().map(|(_, prior)| *prior)
    }

    fn check_names(&self) -> Result<(), CalibrationError> {
        let of = |named: &[&str]| -> Result<(), CalibrationError> {
            for (number, key) in named.iter().enumerate() {
                let key = (*key).to_owned();
                if key == DISPLACEMENT_OFFSET {
                    return Err(CalibrationError::NoForceDepends { key });
                }
                if named[..number].contains(&key.as_str()) {
                    return Err(CalibrationError::Twice { key });
                }
            }
            Ok(())
        };
        let [vary, priors, hold] = [
            self.vary
                .iter()
                .map(|(key, _)| key.as_str())
                .collect::<Vec<_>>(),
            self.priors.iter().map(|(key, _)| key.as_str()).collect(),
            self.hold.iter().map(|(key, _)| key.as_str()).collect(),
        ];
        [&vary, &priors, &hold]
            .into_iter()
            .try_for_each(|named| of(named))?;
        for (key, value) in &self.hold {
            if !is_of_rig(key) {
                return Err(CalibrationError::NotOfRig { key: key.clone() });
            }
            if vary.contains(&key.as_str()) || priors.contains(&key.as_str()) {
                return Err(CalibrationError::HeldAndVaried { key: key.clone() });
            }
            let most = super::rig::largest(key);
            if let Some(value) = value.filter(|value| !(-most..=most).contains(value)) {
                let key = key.clone();
                return Err(CalibrationError::Held { key, value, most });
            }
        }
        for key in priors {
            if !vary.contains(&key) && !is_of_rig(key) {
                let is_known = key
                    .rsplit_once('.')
                    .is_some_and(|(table, last)| plausible::of(table, last).is_some());
                let key = key.to_owned();
                return Err(CalibrationError::PriorOfHeld { key, is_known });
            }
        }
        Ok(())
    }
}
