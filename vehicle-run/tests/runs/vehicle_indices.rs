//! Indices of signals with a closed-form solution, and of a run in a curve.

use std::f64::consts::PI;
use std::fs;

use dashpot_files::case::{Case, CaseOptions};
use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::indices::{LowPass, RideDirection, nadal_limit, prudhomme_limit_n, sperling};
use dashpot_rail::vehicle::Extremes;
use dashpot_vehicle_run::{FILTER_HZ, Indexer, Indices, Run, VehicleTick};
use tempfile::tempdir;

const STEP_S: f64 = 1e-3;
/// At this speed, 2 m are 100 ticks.
const SPEED_M_PER_S: f64 = 20.0;

/// The coach on ideal track at 20 m/s.
fn coach() -> Case {
    CaseOptions::new("coach", "ideal", 3.6 * SPEED_M_PER_S)
        .case()
        .unwrap()
}

/// Values of one tick, the same for every wheelset.
#[derive(Clone, Copy, Default)]
struct Tick {
    /// Acceleration of the first body, in the order of its coordinates.
    acceleration: [f64; 5],
    unbalanced: f64,
    /// Loads and lateral forces (positive towards the middle of the track) of the left and right wheel, N.
    loads_n: [f64; 2],
    lateral_n: [f64; 2],
    /// Sum of creep forces times creepages, N.
    wear_n: f64,
}

/// The tick as a vehicle shows it.
struct Made {
    tick: Tick,
    contacts: Vec<WheelsetForces>,
    extremes: Vec<Extremes>,
}

impl VehicleTick for Made {
    fn distance_m(&self) -> f64 {
        0.0
    }
    fn speed_m_per_s(&self) -> f64 {
        SPEED_M_PER_S
    }
    fn friction_factor(&self) -> f64 {
        1.0
    }
    fn coordinates(&self) -> &[[f64; 5]] {
        &[]
    }
    fn acceleration(&self, body: usize) -> [f64; 5] {
        if body == 0 {
            self.tick.acceleration
        } else {
            [0.0; 5]
        }
    }
    fn unbalanced_m_per_s2(&self) -> f64 {
        self.tick.unbalanced
    }
    fn contacts(&self) -> &[WheelsetForces] {
        &self.contacts
    }
    fn extremes(&self) -> &[Extremes] {
        &self.extremes
    }
    fn damper_displacements_m(&self) -> &[f64] {
        &[]
    }
    fn damper_velocities_m_per_s(&self) -> &[f64] {
        &[]
    }
    fn damper_forces_n(&self) -> &[f64] {
        &[]
    }
    fn friction_forces_n(&self) -> &[f64] {
        &[]
    }
}

fn indices(case: &Case, ticks: impl Iterator<Item = Tick>) -> Indices {
    let mut indexer = Indexer::new(case);
    for tick in ticks {
        let mut forces = WheelsetForces::default();
        for side in 0..2 {
            let wheel = &mut forces.wheels[side];
            let outward = if side == 0 { 1.0 } else { -1.0 };
            wheel.force_n = [0.0, outward * tick.lateral_n[side], -tick.loads_n[side]];
            forces.force_n[1] += wheel.force_n[1];
            // Each wheel contributes half of the wear number.
            wheel.patches[1].load_n = 1.0;
            wheel.patches[1].dissipation_w = 0.5 * tick.wear_n * SPEED_M_PER_S;
        }
        let contacts = vec![forces; case.vehicle.wheelsets.len()];
        let mut extremes = Extremes::NONE;
        extremes.add(&forces);
        indexer.add(&Made {
            tick,
            extremes: vec![extremes; contacts.len()],
            contacts,
        });
    }
    indexer.indices().unwrap()
}

fn is_near(found: f64, expected: f64, part: f64) {
    assert!(
        (found - expected).abs() <= part * expected.abs(),
        "{found} for {expected}"
    );
}

#[test]
fn unloading_is_relative_to_the_load_at_standstill() {
    let case = coach();
    // 44.5 t on four equally loaded axles.
    let bodies = case.vehicle.bodies.iter().map(|body| body.mass_kg);
    let wheelsets = case.vehicle.wheelsets.iter().map(|axle| axle.mass_kg);
    let static_n = bodies.chain(wheelsets).sum::<f64>() * 9.81 / 8.0;
    // The right wheel unloads linearly to a quarter of its load in 1 s, and later lifts for 25 of 2000 ticks.
    let load = |tick: usize| match tick {
        0..1000 => static_n * (1.0 - 0.75 * tick as f64 / 1000.0),
        1500..1525 => 0.0,
        _ => static_n,
    };
    let ticks = (0..2000).map(|tick| Tick {
        loads_n: [static_n, load(tick)],
        ..Tick::default()
    });
    let found = indices(&case, ticks);
    assert_eq!((found.window_m, found.wheelsets.len()), (2.0, 4));
    for wheelset in &found.wheelsets {
        let [left, right] = &wheelset.wheels[..] else {
            panic!()
        };
        is_near(left.load_static_n.unwrap(), static_n, 1e-9);
        assert!(left.unloading_greatest.unwrap().abs() < 1e-9);
        assert_eq!(left.lifted_share, 0.0);
        assert_eq!(right.unloading_greatest, Some(1.0));
        assert_eq!(right.lifted_share, 25.0 / 2000.0);
        // The load has its smallest mean over the last 2 m of the ramp, centred at 0.9495 s. The mean over 2 m that
        // include the lift is larger, because the wheel is lifted for a quarter of them only.
        is_near(
            right.unloading_of_mean_greatest.unwrap(),
            0.75 * 0.9495,
            1e-9,
        );
    }
}

#[test]
fn forces_are_compared_with_nadal_and_prudhomme() {
    let mut case = coach();
    case.friction = 0.36;
    let nadal = nadal_limit(70_f64.to_radians(), 0.36);
    let load_n = 50e3;
    // For a quarter of the window of 2 m, `Y/Q` is one and a half times Nadal's limit; the other wheel's force points
    // outward.
    let step = |tick: usize| {
        if (1000..1025).contains(&tick) {
            1.5
        } else {
            0.25
        }
    };
    let ticks = (0..2000).map(|tick| Tick {
        loads_n: [load_n; 2],
        lateral_n: [step(tick) * nadal * load_n, -0.5 * load_n],
        ..Tick::default()
    });
    let found = indices(&case, ticks);
    is_near(found.nadal.flange_angle_rad.to_degrees(), 70.0, 1e-3);
    is_near(found.nadal.limit, nadal, 2e-3);
    let wheelset = &found.wheelsets[0];
    let [left, right] = &wheelset.wheels[..] else {
        panic!()
    };
    let mut filter = LowPass::new(FILTER_HZ, 1.0 / STEP_S);
    let filtered: Vec<f64> = (0..2000).map(|tick| filter.next(step(tick))).collect();
    let means = filtered
        .windows(100)
        .map(|window| window.iter().sum::<f64>() / 100.0);
    let mean = means.fold(0.0, f64::max);
    // Without the filter the mean would be (25 * 1.5 + 75 * 0.25)/100; the filter rings a little beyond the window.
    is_near(mean, 0.5625, 0.05);
    is_near(left.derailment_greatest, mean * nadal, 1e-9);
    is_near(left.derailment_over_nadal, mean, 2e-3);
    is_near(left.longest_over_nadal_m, 0.5, 1e-9);
    // The magnitude counts, but the wheel does not climb.
    is_near(right.derailment_greatest, 0.5, 1e-9);
    assert_eq!(
        (right.derailment_over_nadal, right.longest_over_nadal_m),
        (0.0, 0.0)
    );
    // Both wheels push to the right.
    let lateral_n = load_n * (mean * nadal + 0.5);
    is_near(wheelset.lateral_force_greatest_n, lateral_n, 1e-9);
    let static_n: f64 = wheelset
        .wheels
        .iter()
        .filter_map(|wheel| wheel.load_static_n)
        .sum();
    let limit_n = prudhomme_limit_n(static_n);
    is_near(wheelset.lateral_force_limit_n.unwrap(), limit_n, 1e-12);
    is_near(
        wheelset.lateral_force_over_limit.unwrap(),
        lateral_n / limit_n,
        1e-9,
    );
}

/// A sine with an offset: mean, root mean square and maximum in closed form.
#[test]
fn wear_numbers_and_unbalanced_acceleration_have_mean_rms_and_greatest() {
    let ticks = (0..4000).map(|tick| {
        let sine = (2.0 * PI * tick as f64 / 1000.0).sin();
        Tick {
            wear_n: 300.0 + 200.0 * sine,
            unbalanced: -0.5 + 0.2 * sine,
            acceleration: [0.3 * sine, 0.0, 0.0, 0.0, 0.0],
            ..Tick::default()
        }
    });
    let found = indices(&coach(), ticks);
    let wheelset = &found.wheelsets[3];
    is_near(wheelset.wear_number_n, 300.0, 1e-9);
    is_near(
        wheelset.wear_number_rms_n,
        (300_f64.powi(2) + 0.5 * 200_f64.powi(2)).sqrt(),
        1e-9,
    );
    is_near(wheelset.wear_number_greatest_n, 500.0, 1e-9);
    is_near(
        found.unbalanced.rms_m_per_s2,
        (0.25_f64 + 0.02).sqrt(),
        1e-9,
    );
    is_near(found.unbalanced.greatest_m_per_s2, 0.7, 1e-9);
    is_near(
        found.bodies[0].lateral_rms_m_per_s2,
        0.3 / 2_f64.sqrt(),
        1e-9,
    );
}

/// A single sine: `N_MV` is six times its weighted root mean square, and Sperling's index is that of the whole signal.
#[test]
fn ride_is_computed_at_the_points_of_the_vehicle_file() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("coach.toml");
    let points = "\n[[ride_point]]\nname = \"seat\"\nbody = \"BODY\"\nat_m = [4.0, 0.5, HEIGHT]\n";
    let plain = coach();
    let body = plain.vehicle.bodies[0].clone();
    let height_m = body.height_m + 0.25;
    let (_, text) = dashpot_files::vehicle::VEHICLES[1];
    let points = points
        .replace("BODY", &body.name)
        .replace("HEIGHT", &height_m.to_string());
    fs::write(&file, format!("{text}{points}")).unwrap();
    let case = CaseOptions::new(file.to_str().unwrap(), "ideal", 72.0)
        .case()
        .unwrap();
    // Roll of 2 rad/s^2 at 2 Hz. The point is 0.25 m above the centre of gravity and 0.5 m to its right, which gives
    // 0.5 m/s^2 laterally and 1 m/s^2 vertically.
    let roll = |tick: usize| 2.0 * (2.0 * PI * 2.0 * tick as f64 * STEP_S).sin();
    let ticks = || {
        (0..12_000).map(|tick| Tick {
            acceleration: [0.0, 0.0, roll(tick), 0.0, 0.0],
            ..Tick::default()
        })
    };
    let found = indices(&case, ticks());
    let [seat] = &found.ride[..] else {
        panic!("{:?}", found.ride)
    };
    assert_eq!((seat.point.as_str(), seat.windows), ("seat", 2));
    assert_eq!((seat.window_s, seat.sperling_band_hz), (5.0, [0.5, 40.0]));
    assert_eq!(seat.at_m, [4.0, 0.5, height_m]);
    for (found, amplitude, direction) in [
        (seat.sperling_lateral, 0.5, RideDirection::Lateral),
        (seat.sperling_vertical, 1.0, RideDirection::Vertical),
    ] {
        let signal: Vec<f64> = (0..5000).map(|tick| 0.5 * amplitude * roll(tick)).collect();
        let expected = sperling(&signal, 1000.0, 5.0, direction).unwrap();
        is_near(found.unwrap(), expected, 1e-9);
    }
    // Published filter gains at 2 Hz.
    let expected = 6.0 * f64::hypot(0.5 * 0.89024, 1.0 * 0.43668) / 2_f64.sqrt();
    is_near(seat.mean_comfort.unwrap(), expected, 5e-3);
    // Without ride points in the file, the points are in the middle and above the bogies, at the height of the centre
    // of gravity.
    let found = indices(&plain, ticks());
    assert_eq!(found.ride.len(), plain.vehicle.bodies.len());
    assert!(found.ride.iter().all(|ride| ride.at_m[2] == body.height_m));
    assert_eq!(found.ride[0].mean_comfort, Some(0.0));
}

/// Curve of 300 m radius at 70 km/h with 0.12 m of cant over 1.5 m, on ideal track: the unbalanced acceleration is `V^2
/// k cos p - g sin p`, and the wheel loads carry weight and centripetal force.
#[test]
fn a_curve_has_the_acceleration_that_cant_does_not_balance() {
    let folder = tempdir().unwrap();
    let track = "name = \"curve\"\n[[part]]\nkind = \"straight\"\nlength_m = 20\n[[part]]\n\
                 kind = \"transition\"\nlength_m = 50\n[[part]]\nkind = \"circular\"\nlength_m = 400\nradius_m = \
                 300\ncant_m = 0.12\n";
    let file = folder.path().join("curve.toml");
    fs::write(&file, track).unwrap();
    let mut options = CaseOptions::new("locomotive", file.to_str().unwrap(), 70.0);
    options.friction = 0.3;
    options.duration_s = 14.0;
    let case = options.case().unwrap();
    let mut run = Run::new(&case).unwrap();
    let mut indexer = Indexer::new(&case);
    let mut loads_n = 0.0;
    while run.step().unwrap().is_none() {
        // From then on, the last axle is in the circular part and the body has settled.
        if run.time_s() > 8.0 {
            indexer.add(run.state());
            let contacts = run.state().contacts().iter();
            loads_n -= contacts.map(|contact| contact.force_n[2]).sum::<f64>();
        }
    }
    let found = indexer.indices().unwrap();
    let centripetal = (70.0_f64 / 3.6).powi(2) / 300.0;
    let sine: f64 = 0.12 / 1.5;
    let cosine = (1.0 - sine * sine).sqrt();
    let expected = centripetal * cosine - 9.81 * sine;
    is_near(expected, 0.4714, 1e-3);
    is_near(found.unbalanced.rms_m_per_s2, expected, 1e-9);
    is_near(found.unbalanced.greatest_m_per_s2, expected, 1e-9);
    // An accelerometer on the body measures the unbalanced acceleration, apart from the remaining motion.
    is_near(found.bodies[0].lateral_rms_m_per_s2, expected, 0.02);
    let ticks = (found.duration_s / STEP_S).round();
    let mass_kg = 123_960.0;
    let down = 9.81 * cosine + centripetal * sine;
    is_near(loads_n / ticks, mass_kg * down, 1e-3);
    let static_n: f64 = found
        .wheelsets
        .iter()
        .flat_map(|wheelset| {
            wheelset
                .wheels
                .iter()
                .filter_map(|wheel| wheel.load_static_n)
        })
        .sum();
    is_near(static_n, mass_kg * 9.81, 1e-9);
    // The outer wheel of the leading axle has the largest load; it does not climb.
    let outer = &found.wheelsets[0].wheels[0];
    assert!((0.3..0.6).contains(&outer.derailment_over_nadal));
    assert_eq!((outer.longest_over_nadal_m, outer.lifted_share), (0.0, 0.0));
}
