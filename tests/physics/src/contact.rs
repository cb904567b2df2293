//! Forces of a wheelset's contact, and elastic patches without tables.

use std::f64::consts::TAU;

use dashpot_files::case::Case;
use dashpot_rail::contact::elastic::{Fineness, Given, NormalContact, TurnedStrips};
use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, WheelsetForces,
};
use dashpot_vehicle_run::contact::ContactSetup;

use crate::bits;

/// Number of motions.
const MOTIONS: u32 = 2000;

/// Forces, moments and patches of the locomotive's first wheelset, tread and flange, on dry and on slippery rails.
pub(super) fn forces() -> Vec<String> {
    let case = Case::load("curve-r300").expect("the case ships");
    let setup = ContactSetup::of_case(&case).expect("a shipped contact");
    let contact = setup.tabulated().expect("a shipped contact").swap_remove(0);
    let mut forces = WheelsetForces::default();
    let mut results = Vec::new();
    for number in 0..MOTIONS {
        contact.update(&motion(number), &rails(number), &mut forces);
        results.extend(
            forces
                .force_n
                .iter()
                .chain(&forces.moment_n_m)
                .map(|x| bits(*x)),
        );
        for patch in forces
            .wheels
            .iter()
            .flat_map(|wheel| wheel.loaded_patches())
        {
            let numbers = [patch.load_n, patch.dissipation_w, patch.peak_pressure_pa];
            results.extend(numbers.map(bits));
        }
    }
    results
}

/// Elastic patches of the standard wheel and rail, from the field side to the flange, under two loads.
pub(super) fn elastic() -> Vec<String> {
    let pair = Pair::standard(Installation::default()).expect("the standard pair");
    let geometry = ContactGeometry::new(pair, Steel::default()).expect("the standard pair");
    let wheel = TurnedStrips::new(geometry.pair(), 1e-3, 5e-3, Fineness::Medium);
    let mut contact = NormalContact::default();
    let mut results = Vec::new();
    for step in -4..=8 {
        for load_n in [50e3, 120e3] {
            let (lateral_m, load) = (1e-3 * f64::from(step), Given::LoadN(load_n));
            let patches = geometry.elastic_patches(&wheel, lateral_m, load, &mut contact);
            for patch in patches {
                let sizes = [patch.load_n, patch.slope, patch.peak_pressure_pa];
                results.extend(sizes.map(bits));
            }
        }
    }
    results
}

/// A sine of the number of a motion, with its own period.
fn sine(number: u32, period: f64) -> f64 {
    libm::sin(TAU * f64::from(number) / period)
}

fn motion(number: u32) -> Motion {
    let speed_m_per_s = 20.0 + 19.0 * sine(number, 211.0);
    Motion {
        speed_m_per_s,
        lateral_m: 7e-3 * sine(number, 97.0),
        vertical_m: 0.1e-3 + 0.4e-3 * sine(number, 31.0),
        roll_rad: 1e-3 * sine(number, 53.0),
        yaw_rad: 8e-3 * sine(number, 71.0),
        lateral_velocity_m_per_s: 0.05 * sine(number, 43.0),
        vertical_velocity_m_per_s: 0.02 * sine(number, 23.0),
        roll_rate_rad_per_s: 0.01 * sine(number, 19.0),
        rotation_rad_per_s: speed_m_per_s / 0.625 * (1.0 + 2e-3 * sine(number, 37.0)),
        yaw_rate_rad_per_s: 0.05 * sine(number, 29.0),
    }
}

fn rails(number: u32) -> [RailDisplacement; 2] {
    [13.0, 17.0].map(|period| RailDisplacement {
        lateral_m: 1e-3 * sine(number, period),
        roll_rad: 1e-3 * sine(number, 2.0 * period),
        friction_ratio: 0.6 + 0.4 * sine(number, 3.0 * period),
        ..RailDisplacement::default()
    })
}
