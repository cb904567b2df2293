//! Contact of a case: profiles, dimensions and friction.

use dashpot_rail::contact::{Installation, Pair, PairError};
use dashpot_rail::creep::Friction;
use dashpot_rail::profile::Body;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::VehicleParameters;
use serde::{Deserialize, Serialize};

use super::error::ContactError;
use super::rail_friction::friction_over_distance;
use super::{ContactOptions, SharedProfile, Wheels};

/// Profiles, dimensions and friction of the wheels and rails of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ContactParameters {
    /// Distinct profiles of wheels and rails.
    profiles: Vec<SharedProfile>,
    /// Profiles of the left and the right wheel of each wheelset.
    wheels: Vec<[usize; 2]>,
    /// Profiles of the left and the right rail.
    rails: [usize; 2],
    /// Distance between the backs of the two flanges, m.
    pub back_to_back_m: f64,
    /// Distance from the back of the flange to the tread datum, m.
    pub back_to_datum_m: f64,
    /// Track gauge, m.
    pub gauge_m: f64,
    /// Depth below the top of the rails at which the gauge is measured, m.
    pub gauge_depth_m: f64,
    /// Inclination of the rails towards the track centre, dimensionless.
    pub rail_inclination: f64,
    /// Ratio of the friction coefficients at infinite and zero sliding speed.
    pub residual_friction_ratio: f64,
    /// Sliding speed at which the falling part of the friction has dropped to 1/e, m/s.
    pub friction_decay_speed_m_per_s: f64,
    /// Gauge along the track: `[distance, gauge]`, m; empty if it does not change.
    pub gauge_over_distance: Vec<[f64; 2]>,
    /// Static friction coefficients along the track: `[distance, left, right]`; a single point if only the rails
    /// differ, empty if both rails have the coefficient of the case everywhere.
    pub friction_over_distance: Vec<[f64; 3]>,
}

impl ContactParameters {
    /// S1002 wheels on UIC 60 rails at 1:40 with constant friction.
    pub fn standard(vehicle: &VehicleParameters) -> Self {
        let wheel_and_rail = [SharedProfile::s1002(), SharedProfile::uic60()];
        let Installation {
            back_to_back_m,
            back_to_datum_m,
            gauge_m,
            gauge_depth_m,
            inclination,
            ..
        } = Installation::STANDARD;
        let constant = Friction::default();
        Self {
            profiles: wheel_and_rail.into(),
            wheels: vec![[0, 0]; vehicle.wheelsets.len()],
            rails: [1, 1],
            back_to_back_m,
            back_to_datum_m,
            gauge_m,
            gauge_depth_m,
            rail_inclination: inclination,
            residual_friction_ratio: constant.residual_ratio,
            friction_decay_speed_m_per_s: constant.decay_speed_m_per_s,
            gauge_over_distance: Vec::new(),
            friction_over_distance: Vec::new(),
        }
    }

    /// Resolves the contact of a vehicle with the wheels of its file: reads the profiles and checks all values.
    /// `friction` is the static coefficient of the case.
    ///
    /// # Errors
    /// An unknown or invalid profile, profiles that do not fit each other, or a value out of bounds.
    ///
    /// ```
    /// use dashpot_files::contact::{ContactOptions, ContactParameters, Wheels};
    /// let vehicle = dashpot_files::vehicle::load("coach", &[])?;
    /// let mut options = ContactOptions::default();
    /// options.gauge_m = Some(1.432);
    /// let contact = ContactParameters::new(&vehicle, Wheels::standard(&vehicle), &options, 0.4)?;
    /// assert_eq!(contact.wheel(3, 1).name(), "S1002");
    /// assert_eq!(contact.installation(0.46).gauge_m, 1.432);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        vehicle: &VehicleParameters,
        mut wheels: Wheels,
        options: &ContactOptions,
        friction: f64,
    ) -> Result<Self, ContactError> {
        if let Some(profile) = options.wheel_choice().load(Body::Wheel)? {
            wheels.replace_all(&profile);
        }
        wheels.replace_some(options.other_wheel.as_deref().unwrap_or(&[]), vehicle)?;
        let both = options.rail_choice().load(Body::Rail)?;
        let both = both.unwrap_or_else(SharedProfile::uic60);
        let [left, right] = options.rail_choices();
        let [left, right] = [left.load(Body::Rail)?, right.load(Body::Rail)?];
        let rails = [left, right].map(|rail| rail.unwrap_or_else(|| both.clone()));
        let standard = Self::standard(vehicle);
        let mut profiles = Vec::new();
        let mut number_of = |profile: SharedProfile| {
            let known = profiles.iter().position(|known| *known == profile);
            known.unwrap_or_else(|| {
                profiles.push(profile);
                profiles.len() - 1
            })
        };
        let wheel_numbers = wheels.profiles.into_iter();
        let wheel_numbers = wheel_numbers
            .map(|sides| sides.map(&mut number_of))
            .collect();
        let rail_numbers = rails.map(&mut number_of);
        let of_vehicle = |option: Option<f64>, of_file: Option<f64>, default: f64| {
            option.or(of_file).unwrap_or(default)
        };
        let contact = Self {
            profiles,
            wheels: wheel_numbers,
            rails: rail_numbers,
            back_to_back_m: of_vehicle(
                options.back_to_back_m,
                wheels.back_to_back_m,
                standard.back_to_back_m,
            ),
            back_to_datum_m: of_vehicle(
                options.back_to_datum_m,
                wheels.back_to_datum_m,
                standard.back_to_datum_m,
            ),
            gauge_m: options.gauge_m.unwrap_or(standard.gauge_m),
            gauge_depth_m: options.gauge_depth_m.unwrap_or(standard.gauge_depth_m),
            rail_inclination: options
                .rail_inclination
                .unwrap_or(standard.rail_inclination),
            residual_friction_ratio: options
                .residual_friction_ratio
                .unwrap_or(standard.residual_friction_ratio),
            friction_decay_speed_m_per_s: options
                .friction_decay_speed_m_per_s
                .unwrap_or(standard.friction_decay_speed_m_per_s),
            gauge_over_distance: options.gauge_over_distance.clone().unwrap_or_default(),
            friction_over_distance: friction_over_distance(options, friction)?,
        };
        contact.check(vehicle, friction)?;
        Ok(contact)
    }

    fn check(&self, vehicle: &VehicleParameters, friction: f64) -> Result<(), ContactError> {
        let falling = self.friction(friction);
        falling.check().map_err(ContactError::of_friction)?;
        let track = |key| move |error| ContactError::new(key, error);
        Track::default()
            .with_gauge(&self.gauge_changes())
            .map_err(track("gauge_over_distance"))?
            .with_friction(&self.friction_ratios(friction))
            .map_err(track("friction_over_distance"))?;
        // The radius only scales the wheel, so any valid one serves.
        let installation = self.installation(Installation::STANDARD.wheel_radius_m);
        installation
            .check()
            .map_err(ContactError::of_installation)?;
        let mut checked = Vec::new();
        for number in 0..vehicle.wheelsets.len() {
            for side in 0..2 {
                let pair = (self.wheels[number][side], self.rails[side]);
                if checked.contains(&pair) {
                    continue;
                }
                checked.push(pair);
                let (wheel, rail) = (self.wheel(number, side), self.rail(side));
                if (wheel, rail) == (&SharedProfile::s1002(), &SharedProfile::uic60()) {
                    continue;
                }
                if let Err(error) = Pair::new((**wheel).clone(), rail, installation) {
                    let key = match &error {
                        PairError::LowRail { .. } => "rail",
                        _ => "wheel",
                    };
                    return Err(ContactError::new(key, error));
                }
            }
        }
        Ok(())
    }

    /// True for S1002 wheels on UIC 60 rails at 1:40 with constant friction.
    pub fn is_standard(&self, vehicle: &VehicleParameters) -> bool {
        *self == Self::standard(vehicle)
    }

    /// Profile of a wheel; `side` is 0 on the left and 1 on the right.
    ///
    /// # Panics
    /// There is no such wheelset or side.
    pub fn wheel(&self, wheelset: usize, side: usize) -> &SharedProfile {
        &self.profiles[self.wheels[wheelset][side]]
    }

    /// Profile of a rail; `side` is 0 on the left and 1 on the right.
    ///
    /// # Panics
    /// There is no such side.
    pub fn rail(&self, side: usize) -> &SharedProfile {
        &self.profiles[self.rails[side]]
    }

    /// Everything but the points and names of the profiles: which wheels and rails have the same profile, by its number
    /// in [`Self::profiles`], all dimensions, and friction.
    pub fn without_profiles(&self) -> Self {
        Self {
            profiles: Vec::new(),
            ..self.clone()
        }
    }

    /// Distinct profiles of wheels and rails.
    pub fn profiles(&self) -> &[SharedProfile] {
        &self.profiles
    }

    /// Dimensions of a wheelset with wheels of a radius, m, on its track.
    pub fn installation(&self, wheel_radius_m: f64) -> Installation {
        Installation::default()
            .with_wheel_radius_m(wheel_radius_m)
            .with_back_to_back_m(self.back_to_back_m)
            .with_back_to_datum_m(self.back_to_datum_m)
            .with_gauge_m(self.gauge_m)
            .with_gauge_depth_m(self.gauge_depth_m)
            .with_inclination(self.rail_inclination)
    }

    /// Friction with a static coefficient.
    pub fn friction(&self, static_coefficient: f64) -> Friction {
        Friction::constant(static_coefficient)
            .with_residual_ratio(self.residual_friction_ratio)
            .with_decay_speed_m_per_s(self.friction_decay_speed_m_per_s)
    }

    /// Largest static friction coefficient of a rail along the track; `friction` is the coefficient of the case, and
    /// `side` is 0 on the left and 1 on the right.
    pub fn greatest_friction(&self, side: usize, friction: f64) -> f64 {
        let along = self.friction_over_distance.iter();
        let along = along.map(|[_, left, right]| [*left, *right][side]);
        along.reduce(f64::max).unwrap_or(friction)
    }

    /// Changes of the gauge along the track, `[distance, change]`, m.
    pub(crate) fn gauge_changes(&self) -> Vec<[f64; 2]> {
        let along = self.gauge_over_distance.iter();
        along
            .map(|[at_m, gauge_m]| [*at_m, gauge_m - self.gauge_m])
            .collect()
    }

    /// Factors on the friction coefficient of the case along the track, `[distance, left, right]`.
    pub(crate) fn friction_ratios(&self, friction: f64) -> Vec<[f64; 3]> {
        let along = self.friction_over_distance.iter();
        along
            .map(|[at_m, left, right]| [*at_m, left / friction, right / friction])
            .collect()
    }
}
