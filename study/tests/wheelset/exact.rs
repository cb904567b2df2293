//! Patches and forces against exact results that an independent solver computed.

use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
use dashpot_study::loaded_wheelset::{LoadedWheel, LoadedWheelset, Running};

/// One wheel S1002 on one rail UIC 60 without roll and yaw, friction 0.3, 20 m/s, 32 rad/s; the wheel carries the load.
const FILES: [(f64, &str); 2] = [
    (
        100e3,
        include_str!("../../../rail/data/contact_exact_100kn.csv"),
    ),
    (
        30e3,
        include_str!("../../../rail/data/contact_exact_30kn.csv"),
    ),
];

fn wheelset(load_n: f64) -> LoadedWheelset {
    let installation = Installation::default().with_wheel_radius_m(0.625);
    let steel = Steel::default()
        .with_young_modulus_pa(2.0 * 82e9 * 1.28)
        .with_poisson_ratio(0.28);
    let pair = Pair::standard(installation).unwrap();
    let side = Arc::new(ContactGeometry::new(pair, steel).unwrap());
    let running = Running::default()
        .with_load_n(load_n)
        .with_speed_m_per_s(20.0)
        .with_friction(0.3)
        .with_roll_rad(Some(0.0))
        .with_rotation_rad_per_s(Some(32.0));
    LoadedWheelset::new([Arc::clone(&side), side], running).unwrap()
}

struct Case {
    lateral_m: f64,
    position_m: f64,
    angle_rad: f64,
    peak_pressure_pa: f64,
    /// Forces on the rail along x and y, N.
    force_n: [f64; 2],
}

fn cases(text: &str) -> Vec<Case> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let read = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |name: &str| {
            let column = names.iter().position(|other| *other == name).unwrap();
            cells[column].parse::<f64>().unwrap()
        };
        Case {
            lateral_m: 1e-3 * number("y_mm"),
            position_m: 1e-3 * number("ycp_mm"),
            angle_rad: -number("delta_cp_rad"),
            peak_pressure_pa: 1e6 * number("pmax_mpa"),
            force_n: [number("fx_rail_n"), number("fy_rail_n")],
        }
    };
    lines.map(read).collect()
}

/// Mean over the patches, weighted by their loads.
fn mean(
    wheel: &LoadedWheel,
    of: impl Fn(&dashpot_study::loaded_wheelset::LoadedPatch) -> f64,
) -> f64 {
    let load_n: f64 = wheel.patches.iter().map(|patch| patch.load_n).sum();
    let sum: f64 = wheel
        .patches
        .iter()
        .map(|patch| patch.load_n * of(patch))
        .sum();
    sum / load_n
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

#[test]
fn patches_and_forces_are_those_of_exact_theory() {
    for (load_n, text) in FILES {
        let cases = cases(text);
        assert!(cases.len() > 15);
        let shifts_m: Vec<f64> = cases.iter().map(|case| case.lateral_m).collect();
        let shifts = wheelset(load_n).at(&shifts_m).unwrap();
        let (mut positions_mm, mut angles_mrad) = (Vec::new(), Vec::new());
        for (case, shift) in cases.iter().zip(&shifts) {
            let wheel = shift.right.as_ref().unwrap();
            let name = format!("{load_n} N, {} mm", 1e3 * case.lateral_m);
            assert!(
                (wheel.vertical_force_n / load_n - 1.0).abs() < 1e-3,
                "{name}"
            );
            let peak_pa = wheel.patches.iter().map(|patch| patch.peak_pressure_pa);
            let pressure = peak_pa.fold(0.0, f64::max) / case.peak_pressure_pa;
            let along = (-wheel.longitudinal_force_n - case.force_n[0]) / (0.3 * load_n);
            let across = (wheel.lateral_force_n - case.force_n[1]) / load_n;
            let off_mm = 1e3 * (mean(wheel, |patch| patch.track_y_m) - case.position_m);
            assert!(
                (pressure - 1.0).abs() < 0.2,
                "{name}: {pressure} of the pressure"
            );
            // Beyond 6.5 mm, the contact moves to the face of the flange within a tenth of a millimetre of shift.
            if case.lateral_m < 6.6e-3 {
                positions_mm.push(off_mm);
            }
            if case.lateral_m < 6.1e-3 {
                let angle_rad = mean(wheel, |patch| patch.contact_angle_rad);
                angles_mrad.push(1e3 * (angle_rad - case.angle_rad));
                assert!(
                    along.abs() < 0.07,
                    "{name}: {along} of the friction limit along"
                );
                assert!(across.abs() < 0.03, "{name}: {across} of the load across");
            }
        }
        let (position, angle) = (rms(&positions_mm), rms(&angles_mrad));
        println!("{load_n} N: position {position} mm, angle {angle} mrad RMS");
        assert!(position < 0.25, "{load_n} N: {position} mm RMS");
        assert!(angle < 8.0, "{load_n} N: {angle} mrad RMS");
    }
}
