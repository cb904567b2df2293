//! Steps one damper once per tick: `cargo run -p dashpot-core --example step`.

use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_core::{BuildError, Damper};

fn main() -> Result<(), BuildError> {
    // A reduced damper: 120 kN s/m up to 0.03 m/s, 8 MN/m in series, clearance 2a of 1 mm.
    let mount = Mount::new(8e6).clearance_m(1e-3);
    let parameters = DamperParameters::reduced(120e3, 0.03, mount);
    let damper: Damper<f32> = parameters.build(1e-3)?;

    let mut state = damper.at_rest(0.0);
    println!("time_s,displacement_m,force_n");
    for tick in 0..=1000 {
        let time_s = 1e-3 * tick as f32;
        // 3 mm at 1.5 Hz.
        let displacement_m = 3e-3 * (std::f32::consts::TAU * 1.5 * time_s).sin();
        let force_n = damper.step(&mut state, displacement_m);
        println!("{time_s:.3},{displacement_m:.6},{force_n:.1}");
    }
    eprintln!("status: {:?}", state.status());
    Ok(())
}
