//! Equivalent conicity of S1002 on UIC 60 as a function of the amplitude, for gauges from 1430 to 1440 mm.
//!
//! `cargo run -p dashpot-rail --example conicity`

use dashpot_rail::contact::{Installation, Pair};
use dashpot_rail::indices::RollingRadiusDifference;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("gauge mm   2 mm    3 mm    4 mm");
    for gauge_mm in [1430.0, 1435.0, 1440.0] {
        let installation = Installation::default().with_gauge_m(gauge_mm * 1e-3);
        let pair = Pair::standard(installation)?;
        let difference = RollingRadiusDifference::of(&pair, 12e-3, 960)?;
        print!("{gauge_mm:8}");
        for amplitude_m in [2e-3, 3e-3, 4e-3] {
            match difference.equivalent_conicity(amplitude_m, installation.wheel_radius_m) {
                Some(conicity) => print!("  {conicity:.4}"),
                None => print!("       -"),
            }
        }
        println!();
    }
    Ok(())
}
