//! Regression: the eigenvalue iteration had no exceptional shifts. At some speeds of an ordinary wheelset it cycled,
//! and the modes were rejected because the values were "too far apart".

use dashpot_rail::vehicle::Running;

use crate::running::{cone, free_wheelset};

#[test]
fn a_conical_wheelset_has_modes_at_every_speed() {
    let (contact, vehicle) = (cone(), free_wheelset());
    for number in 1..=96 {
        let speed = 0.75 * f64::from(number);
        let running = Running::new(&vehicle, &contact, speed).unwrap();
        let modes = running
            .modes()
            .unwrap_or_else(|error| panic!("{speed} m/s: {error}"));
        assert!(
            modes
                .iter()
                .any(|mode| mode.description() == "wheelset lateral"),
            "{speed} m/s"
        );
    }
}
