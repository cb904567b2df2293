//! Forces on a wheelset of 206 kN that is shifted until its flange touches, for three creep laws.
//!
//! `cargo run --release -p dashpot-rail --example wheelset`

use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{CreepLaw, Friction, KalkerBook, Polach, ShenHedrickElkins};

const LOAD_N: f64 = 206e3;
const SPEED_M_PER_S: f64 = 27.8;

/// Prints the lateral force, the steering moment, and the derailment coefficient of the right wheel.
fn print(
    name: &str,
    tables: &Arc<Tables>,
    law: impl CreepLaw,
) -> Result<(), Box<dyn std::error::Error>> {
    println!("{name}\nshift mm  lateral kN  steering kN m  right Y/Q  status");
    let contact = WheelsetContact::new(Arc::clone(tables), law, Friction::default())?;
    let rails = [RailDisplacement::default(); 2];
    let radius_m = tables.geometry().pair().installation().wheel_radius_m;
    for shift_mm in 0..7 {
        // Finds the vertical position at which the rails carry the load, by bisection.
        let (mut high, mut low) = (-2e-3, 1e-3);
        let mut motion = Motion {
            speed_m_per_s: SPEED_M_PER_S,
            rotation_rad_per_s: SPEED_M_PER_S / radius_m,
            lateral_m: f64::from(shift_mm) * 1e-3,
            ..Motion::default()
        };
        for _ in 0..40 {
            motion.vertical_m = 0.5 * (high + low);
            if -contact.forces(&motion, &rails).force_n[2] < LOAD_N {
                high = motion.vertical_m;
            } else {
                low = motion.vertical_m;
            }
        }
        let forces = contact.forces(&motion, &rails);
        println!(
            "{shift_mm:8}  {:10.2}  {:13.2}  {:9.3}  {:?}",
            forces.force_n[1] * 1e-3,
            forces.moment_n_m[2] * 1e-3,
            forces.derailment_coefficients()[1],
            forces.status
        );
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pair = Pair::standard(Installation::default())?;
    let geometry = ContactGeometry::new(pair, Steel::default())?;
    let tables = Arc::new(Tables::new(geometry));
    print("Kalker's book of tables", &tables, KalkerBook::new())?;
    print("Polach", &tables, Polach)?;
    print("Shen, Hedrick and Elkins", &tables, ShenHedrickElkins)
}
