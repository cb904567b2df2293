//! Wears S1002 on UIC 60 into a family of worn pairs and sweeps each over its rail: prints the greatest change of the
//! lateral force over a micrometre.
//!
//! `cargo run --release -p dashpot-wear --example family -- [every|few]`: `few` (default) sweeps few yaws and loads.

#[path = "../tests/support/sweep.rs"]
mod sweep;

use std::sync::Arc;
use std::time::Instant;

use dashpot_rail::contact::{ContactGeometry, Pair, Steel, Tables};
use dashpot_wear::procedure::{Procedure, family};
use sweep::{Given, SHIFTS_M, STEP_M, contact, greatest_change};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let every = std::env::args().nth(1).as_deref() == Some("every");
    let started = Instant::now();
    let members = family()?;
    println!("{} pairs in {:.1?}", members.len(), started.elapsed());
    let yaws_mrad: Vec<i32> = if every {
        (-10..=10).collect()
    } else {
        vec![-10, -4, 0, 4, 10]
    };
    let loads_n: &[f64] = if every {
        &[25e3, 50e3, 75e3, 100e3, 150e3]
    } else {
        &[50e3, 100e3, 150e3]
    };
    for member in members {
        let pair = &member.pair;
        println!(
            "{}: {:.1} mm, {:.0} km",
            member.name,
            1e3 * pair.wheel_depth_m(),
            1e-3 * pair.distance_m
        );
        let laid = Pair::new(
            pair.wheel.clone(),
            &pair.rail,
            Procedure::default().installation,
        )?;
        let started = Instant::now();
        let tables = Arc::new(Tables::new(ContactGeometry::new(laid, Steel::default())?));
        println!(
            "  tables: {:.1?}, {:.1} MB",
            started.elapsed(),
            1e-6 * tables.bytes() as f64
        );
        for friction in [0.0, 0.3] {
            let contact = contact(&tables, friction);
            for load_n in loads_n {
                let mut worst = (0.0, 0, 0.0, [0.0; 2]);
                for yaw_mrad in &yaws_mrad {
                    let given = Given {
                        side: 1,
                        roll_rad: 0.0,
                        yaw_rad: 1e-3 * f64::from(*yaw_mrad),
                        load_n: *load_n,
                    };
                    let change = greatest_change(&contact, &given, SHIFTS_M, STEP_M);
                    if change.change_n > worst.0 {
                        worst = (
                            change.change_n,
                            *yaw_mrad,
                            change.lateral_m,
                            change.forces_n,
                        );
                    }
                }
                println!(
                    "  friction {friction}, {:.0} kN: {:.2} kN at {} mrad, {:.3} mm ({:.1?} N)",
                    1e-3 * load_n,
                    1e-3 * worst.0,
                    worst.1,
                    1e3 * worst.2,
                    worst.3
                );
            }
        }
    }
    Ok(())
}
