//! Prints data/excitations/ride_made.csv: the synthetic ride as a logger would have recorded it.
//!
//! `cargo run --package dashpot-hil --example make_ride > data/excitations/ride_made.csv`

use dashpot_testbench::excitation::Excitation;

/// Grid of the time stamps, s.
const GRID_S: f64 = 1e-4;

fn main() {
    let x = Excitation::Ride.displacements_m(GRID_S);
    print!("\u{feff}");
    for line in [
        "# MADE, not measured: relative displacement of a secondary damper's seats, positive in extension.",
        "# dashpot_testbench::excitation::Excitation::Ride, 0.4-20 Hz, 0.04 m/s rms, 5 s, taken at stamps of",
        "# 1.6 to 2.4 ms from a fixed sequence, with one gap of 40 ms after 2 s; rounded to 10 nm.",
        "# Made by: cargo run --package dashpot-hil --example make_ride",
        "time_s,displacement_m",
    ] {
        print!("{line}\r\n");
    }
    let mut seed = 0x9e37_79b9_u32;
    let (mut index, mut gap) = (0, 400);
    while index < x.len() {
        print!("{:.4},{:.8}\r\n", index as f64 * GRID_S, x[index]);
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        index += 16 + seed as usize % 9;
        if index >= 20_000 {
            index += std::mem::take(&mut gap);
        }
    }
}
