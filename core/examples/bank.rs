//! Steps the dampers of a locomotive in one call and checks one of them for damage in memory:
//! `cargo run -p dashpot-core --example bank`.

use std::error::Error;

use dashpot_core::integrity::Check;
use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_core::{Damper, step_bank};

fn main() -> Result<(), Box<dyn Error>> {
    let vertical: Damper<f32> =
        DamperParameters::reduced(120e3, 0.03, Mount::new(8e6)).build(1e-3)?;
    let lateral: Damper<f32> = DamperParameters::reduced(60e3, 0.1, Mount::new(5e6)).build(1e-3)?;

    // Eight vertical and four lateral dampers. One damper serves many states.
    let dampers: [&Damper<f32>; 12] =
        core::array::from_fn(|index| if index < 8 { &vertical } else { &lateral });
    let mut states = dampers.map(|damper| damper.at_rest(0.0));
    let mut forces_n = [0.0; 12];
    let mut check = Check::START;
    for tick in 0..1000 {
        // The velocity is 0.02 m/s for the first damper and smaller for each following one.
        let displacements_m =
            core::array::from_fn(|index| 0.02e-3 * tick as f32 / (1.0 + index as f32));
        step_bank(&dampers, &mut states, &displacements_m, &mut forces_n);
        check.slice(&vertical)?;
    }
    for (index, force_n) in forces_n.iter().enumerate() {
        println!("damper {index:2}: {force_n:7.1} N");
    }
    Ok(())
}
