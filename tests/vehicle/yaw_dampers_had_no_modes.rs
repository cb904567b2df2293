//! Fixed bug: the modes of a locomotive with ordinary yaw dampers were rejected as "too far apart" at some speeds,
//! because the eigenvalue iteration did not converge but cycled.

use std::sync::OnceLock;

use dashpot_rail::contact::{ContactGeometry, WheelsetContact};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::vehicle::{Running, VehicleParameters};

use crate::support::contact_without_tables;

/// The shipped locomotive with a yaw damper on each side of each bogie.
const LOCOMOTIVE: &str = include_str!("locomotive_yaw_dampers.toml");

/// The locomotive with yaw dampers of this damping and mount stiffness.
pub fn locomotive(damping_n_s_per_m: f64, stiffness_n_per_m: f64) -> VehicleParameters {
    let text = LOCOMOTIVE
        .replace(
            "damping_n_s_per_m=1.32e6",
            &format!("damping_n_s_per_m={damping_n_s_per_m:e}"),
        )
        .replace(
            "stiffness_n_per_m=12e6",
            &format!("stiffness_n_per_m={stiffness_n_per_m:e}"),
        );
    dashpot_files::vehicle::parse("locomotive_yaw_dampers.toml", &text, &[]).unwrap()
}

pub fn contact() -> &'static WheelsetContact<KalkerBook, ContactGeometry> {
    static CONTACT: OnceLock<WheelsetContact<KalkerBook, ContactGeometry>> = OnceLock::new();
    CONTACT.get_or_init(contact_without_tables)
}

#[test]
fn the_reported_locomotive_has_modes() {
    let running = Running::new(&locomotive(4.1e6, 12e6), contact(), 50.0).unwrap();
    let modes = running.modes().unwrap();
    assert!(modes.iter().all(|mode| mode.undamped_hz() > 0.0));
    assert!(modes.iter().any(|mode| mode.description() == "body bounce"));
}

/// All 270 combinations of 9 dampings, 2 mount stiffnesses and 15 speeds have modes.
#[test]
fn usual_yaw_dampers_have_modes_at_every_speed() {
    let mut combinations = 0;
    for damping in [0.3e6, 0.6e6, 0.9e6, 1.32e6, 1.9e6, 2.5e6, 3.2e6, 4.1e6, 5e6] {
        for stiffness in [6e6, 12e6] {
            let vehicle = locomotive(damping, stiffness);
            for km_h in (40..=320).step_by(20) {
                let running = Running::new(&vehicle, contact(), f64::from(km_h) / 3.6).unwrap();
                let values = running.eigenvalues_rad_per_s();
                assert!(values.is_ok(), "{damping} {stiffness} {km_h}: {values:?}");
                combinations += 1;
            }
        }
    }
    assert_eq!(combinations, 270);
}
