//! Injects a fault into a running rig: another damper takes over the state, and the force stays continuous.
//!
//! `cargo run -p dashpot-core --example swap`.

use std::error::Error;

use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_core::{Damper, Loading, Status};

fn main() -> Result<(), Box<dyn Error>> {
    let healthy: Damper<f32> =
        DamperParameters::reduced(120e3, 0.03, Mount::new(8e6)).build(1e-3)?;
    let worn: Damper<f32> = DamperParameters::reduced(40e3, 0.1, Mount::new(8e6)).build(1e-3)?;

    // A host sends the image and the firmware loads it, checked and in slices between ticks.
    let image = worn.to_image();
    let mut loaded = healthy;
    let mut loading = Loading::START;

    let mut state = healthy.at_rest(0.0);
    let mut swapped = false;
    let mut last_n = 0.0_f32;
    for tick in 1..=1000 {
        let damper = if swapped { &loaded } else { &healthy };
        let force_n = damper.step(&mut state, 0.02e-3 * tick as f32); // 0.02 m/s
        if state.status().contains(Status::DAMPER_SWAPPED) {
            println!("tick {tick}: {last_n:.1} N, then {force_n:.1} N");
            state.clear_status();
        }
        last_n = force_n;
        if !swapped {
            swapped = loaded.load_slice(&image, &mut loading)?;
        }
    }
    println!("at the end: {last_n:.1} N");

    // A saved state is restored exactly.
    let saved = state.save();
    assert_eq!(loaded.restore(&saved)?, state);
    Ok(())
}
