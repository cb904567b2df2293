//! The iteration for the eigenvalues had no exceptional shifts: at some speeds of an ordinary wheelset it turned in a circle, and its
//! modes were refused as "too far apart".

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
            modes.iter().any(|mode| mode.words() == "wheelset lateral"),
            "{speed} m/s"
        );
    }
}
