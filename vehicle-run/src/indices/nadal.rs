//! Nadal's limit of each wheel of a case.

use std::sync::OnceLock;

use dashpot_files::case::Case;
use dashpot_files::contact::SharedProfile;
use dashpot_rail::contact::{Installation, Pair};
use dashpot_rail::indices::nadal_limit;
use dashpot_rail::profile::uic60;
use serde::Serialize;

use crate::signals::SIDES;

/// Nadal's limit of `Y/Q`, with the values from which it is computed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nadal {
    /// Flange angle of the wheel profile, rad.
    pub flange_angle_rad: f64,
    /// Friction coefficient of wheel and rail: the largest along the track, at which the limit is lowest.
    pub friction: f64,
    /// The limit, dimensionless.
    pub limit: f64,
    /// Name of the wheel profile.
    pub profile: String,
    /// Wheels with this limit.
    pub wheels: Vec<NadalWheel>,
}

/// A wheel of a vehicle.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NadalWheel {
    /// Name of the wheelset.
    pub wheelset: String,
    /// Side, `left` or `right`.
    pub side: &'static str,
}

impl Nadal {
    /// Computes the distinct limits of a case, in the order of the wheels, and the index of the limit of the left and
    /// the right wheel of each wheelset.
    pub(super) fn of_case(case: &Case) -> (Vec<Self>, Vec<[usize; 2]>) {
        let mut limits: Vec<(SharedProfile, Self)> = Vec::new();
        let mut wheelsets = Vec::new();
        for (number, wheelset) in case.vehicle.wheelsets.iter().enumerate() {
            wheelsets.push([0, 1].map(|side| {
                let profile = case.contact.wheel(number, side);
                let friction = case.contact.greatest_friction(side, case.friction);
                let wheel = NadalWheel {
                    wheelset: wheelset.name.clone(),
                    side: SIDES[side],
                };
                let is_same = |(known, nadal): &(SharedProfile, Self)| {
                    nadal.friction == friction && known == profile
                };
                if let Some(known) = limits.iter().position(is_same) {
                    limits[known].1.wheels.push(wheel);
                    return known;
                }
                let flange_angle_rad = flange_angle_rad(profile);
                let nadal = Self {
                    flange_angle_rad,
                    friction,
                    limit: nadal_limit(flange_angle_rad, friction),
                    profile: profile.name().to_owned(),
                    wheels: vec![wheel],
                };
                limits.push((profile.clone(), nadal));
                limits.len() - 1
            }));
        }
        (
            limits.into_iter().map(|(_, nadal)| nadal).collect(),
            wheelsets,
        )
    }
}

/// Flange angle of a wheel profile, rad. It depends neither on the wheel radius nor on the rail.
fn flange_angle_rad(wheel: &SharedProfile) -> f64 {
    // Building a profile pair takes longer than simulating one second.
    static STANDARD: OnceLock<f64> = OnceLock::new();
    let angle = || {
        let pair = Pair::new(
            (**wheel).clone(),
            &uic60::profile(),
            Installation::default(),
        );
        // The contact of a case has checked that its wheels have a flange.
        pair.map_or(f64::NAN, |pair| pair.flange_angle_rad())
    };
    if *wheel == SharedProfile::s1002() {
        *STANDARD.get_or_init(angle)
    } else {
        angle()
    }
}
