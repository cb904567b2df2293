//! Wheels of a vehicle: the table `[contact]` of a vehicle file.

use std::path::Path;

use dashpot_rail::profile::Body;
use dashpot_rail::vehicle::VehicleParameters;
use serde::Deserialize;

use super::SharedProfile;
use super::choice::Choice;
use super::error::ContactError;
use super::options::{OtherWheel, Side, WHEEL_KEYS};
use crate::overrides::did_you_mean;
use crate::shipped::resolve_name;

/// Wheels of a vehicle, as its file describes them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Wheels {
    /// Profiles of the left and the right wheel of each wheelset.
    pub profiles: Vec<[SharedProfile; 2]>,
    /// Distance between the backs of the two flanges, m; `None` for the default.
    pub back_to_back_m: Option<f64>,
    /// Distance from the back of the flange to the tread datum, m; `None` for the default.
    pub back_to_datum_m: Option<f64>,
}

impl Wheels {
    /// Wheels with the profile S1002 and the default dimensions, on each wheelset of a vehicle.
    pub fn standard(vehicle: &VehicleParameters) -> Self {
        let profile = SharedProfile::s1002();
        Self {
            profiles: vec![[profile.clone(), profile]; vehicle.wheelsets.len()],
            back_to_back_m: None,
            back_to_datum_m: None,
        }
    }

    /// Replaces the profile of all wheels.
    pub(super) fn replace_all(&mut self, profile: &SharedProfile) {
        self.profiles.fill([profile.clone(), profile.clone()]);
    }

    /// Replaces the profiles of the wheels in a list.
    pub(super) fn replace_some(
        &mut self,
        others: &[OtherWheel],
        vehicle: &VehicleParameters,
    ) -> Result<(), ContactError> {
        for other in others {
            let names = || {
                vehicle
                    .wheelsets
                    .iter()
                    .map(|wheelset| wheelset.name.as_str())
            };
            let Some(wheelset) = names().position(|name| name == other.wheelset) else {
                let known: Vec<&str> = names().collect();
                let reason = format!(
                    "no wheelset `{}`, allowed: {}{}",
                    other.wheelset,
                    known.join(", "),
                    did_you_mean(&other.wheelset, names())
                );
                return Err(ContactError::other("other_wheel", reason));
            };
            let Some(profile) = other.choice().load(Body::Wheel)? else {
                continue;
            };
            let [left, right] = &mut self.profiles[wheelset];
            if other.side != Some(Side::Right) {
                *left = profile.clone();
            }
            if other.side != Some(Side::Left) {
                *right = profile;
            }
        }
        Ok(())
    }
}

/// Table `[contact]` of a vehicle file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelsTable {
    wheel: Option<String>,
    wheel_format: Option<String>,
    wheel_mirror: Option<String>,
    wheel_smoothing_m: Option<f64>,
    #[serde(default)]
    other_wheel: Vec<OtherWheel>,
    back_to_back_m: Option<f64>,
    back_to_datum_m: Option<f64>,
}

impl WheelsTable {
    /// Loads the wheels of `vehicle`; names of files are relative to `folder`, the directory of the vehicle file.
    pub fn wheels(
        mut self,
        vehicle: &VehicleParameters,
        folder: &Path,
    ) -> Result<Wheels, ContactError> {
        self.wheel = self.wheel.map(|name| resolve_name(folder, &name));
        for other in &mut self.other_wheel {
            other.resolve_files(folder);
        }
        let mut wheels = Wheels {
            back_to_back_m: self.back_to_back_m,
            back_to_datum_m: self.back_to_datum_m,
            ..Wheels::standard(vehicle)
        };
        let choice = Choice {
            keys: WHEEL_KEYS,
            name: self.wheel.as_deref(),
            format: self.wheel_format.as_deref(),
            mirror: self.wheel_mirror.as_deref(),
            smoothing_m: self.wheel_smoothing_m,
        };
        if let Some(profile) = choice.load(Body::Wheel)? {
            wheels.replace_all(&profile);
        }
        wheels.replace_some(&self.other_wheel, vehicle)?;
        Ok(wheels)
    }
}
