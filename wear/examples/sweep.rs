//! Sweeps a wheel of a pair of profile files over its rail under constant load and prints the greatest change of the
//! lateral force over a micrometre.
//!
//! `cargo run --release -p dashpot-wear --example sweep -- wheel.prw rail.prr [key=value]...` with the keys `gauge_m`,
//! `gauge_depth_m`, `back_to_back_m`, `radius_m`, `inclination`, `roll_mrad`.

#[path = "../tests/support/sweep.rs"]
mod sweep;

use std::sync::Arc;
use std::time::Instant;

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables};
use dashpot_rail::profile::measured::{self, Options};
use dashpot_rail::profile::{Body, Profile};
use sweep::{Given, SHIFTS_M, STEP_M, contact, greatest_change, under_load};

fn read(path: &str, body: Body) -> Result<Profile, Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string(path)?;
    Ok(measured::parse(path, &text, body, &Options::default())?.0)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [wheel, rail, settings @ ..] = &arguments[..] else {
        return Err("usage: sweep WHEEL RAIL [KEY=VALUE]...".into());
    };
    let mut installation = Installation::default();
    let mut roll_rad = 0.0;
    let mut points = Vec::new();
    for setting in settings {
        let (key, value) = setting.split_once('=').ok_or("KEY=VALUE")?;
        let value: f64 = value.parse()?;
        match key {
            "gauge_m" => installation.gauge_m = value,
            "gauge_depth_m" => installation.gauge_depth_m = value,
            "back_to_back_m" => installation.back_to_back_m = value,
            "radius_m" => installation.wheel_radius_m = value,
            "inclination" => installation.inclination = value,
            "roll_mrad" => roll_rad = 1e-3 * value,
            "at_mm" => points.push(1e-3 * value),
            _ => return Err(format!("unknown key {key}").into()),
        }
    }
    let (wheel, rail) = (read(wheel, Body::Wheel)?, read(rail, Body::Rail)?);
    let pair = Pair::new(wheel, &rail, installation)?;
    let tables = Arc::new(Tables::new(ContactGeometry::new(pair, Steel::default())?));
    for friction in [0.0, 0.3] {
        let contact = contact(&tables, friction);
        let mut height_m = 0.0;
        for lateral_m in &points {
            let given = Given {
                side: 1,
                roll_rad,
                yaw_rad: 5e-3,
                load_n: 100e3,
            };
            let Some(wheel) = under_load(&contact, &given, *lateral_m, &mut height_m) else {
                println!("{:.3} mm: no height carries the load", 1e3 * lateral_m);
                continue;
            };
            let loads: Vec<String> = wheel
                .patches
                .iter()
                .map(|patch| {
                    format!(
                        "{:.1} kN at {:.1} mm",
                        1e-3 * patch.load_n,
                        1e3 * patch.wheel_y_m
                    )
                })
                .collect();
            println!(
                "friction {friction}, {:.3} mm: lateral {:.1} kN, {loads:?}",
                1e3 * lateral_m,
                1e-3 * wheel.force_n[1],
            );
        }
        for load_n in [50e3, 100e3, 150e3] {
            for yaw_mrad in [-10, -5, -2, 0, 2, 5, 10] {
                let given = Given {
                    side: 1,
                    roll_rad,
                    yaw_rad: 1e-3 * f64::from(yaw_mrad),
                    load_n,
                };
                let started = Instant::now();
                let worst = greatest_change(&contact, &given, SHIFTS_M, STEP_M);
                println!(
                    "friction {friction}, {load_n} N, {yaw_mrad} mrad: {:.2} kN at {:.3} mm, {:.1?} N ({:.0?})",
                    1e-3 * worst.change_n,
                    1e3 * worst.lateral_m,
                    worst.forces_n,
                    started.elapsed()
                );
            }
        }
    }
    Ok(())
}
