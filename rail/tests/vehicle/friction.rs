//! Free oscillations of a body with dry friction against closed forms.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, FrictionLoad, GRAVITY_M_PER_S2, Law, Standstill, Vehicle,
    VehicleError, VehicleParameters,
};

use crate::support::{contact, four_springs, free_wheelset};

const MASS_KG: f64 = 20e3;
/// Stiffness of the four springs together, N/m.
const SPRINGS: f64 = 1e6;
/// Stiffness of the spring in series with the slider, N/m.
const SERIES: f64 = 1e9;

/// A body on four springs to the track, with a vertical friction element in its middle; `upside_down` swaps the ends.
fn suspended(friction_n: f64, load: Option<FrictionLoad>, upside_down: bool) -> VehicleParameters {
    let at = [0.0, 0.0, 1.5];
    let law = Law::Friction {
        direction: Direction::Vertical,
        stiffness_n_per_m: SERIES,
        friction_n,
        load,
    };
    let mut ends = [End::track(at), End::body("body", at)];
    let mut springs = four_springs("body", [0.25 * SPRINGS; 3], 0.0, [3.0, 1.0, 1.5]);
    if upside_down {
        ends.swap(0, 1);
        for spring in &mut springs {
            spring.ends.swap(0, 1);
        }
    }
    VehicleParameters::new("suspended")
        .with_bodies([Body::new("body", MASS_KG, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([free_wheelset()])
        .with_elements(springs)
        .with_elements([Element::new("friction", ends, law)])
}

/// Displacement, friction force and position of the slider after each tick of 0.25 ms from a release at `start_m`.
fn released(parameters: &VehicleParameters, start_m: f64, seconds: f64) -> Vec<[f64; 3]> {
    let vehicle = Vehicle::new(parameters, contact(0.0), 0.25e-3).unwrap();
    assert_eq!(vehicle.friction_names().collect::<Vec<_>>(), ["friction"]);
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    vehicle
        .displace(&mut state, &track, 0, [0.0, start_m, 0.0, 0.0, 0.0])
        .unwrap();
    let ticks = (seconds / vehicle.step_s()).round() as usize;
    let mut motion = Vec::with_capacity(ticks);
    for _ in 0..ticks {
        vehicle.step(&mut state, &track);
        let (force, slider) = (state.friction_forces_n()[0], state.sliders_m()[0]);
        motion.push([state.coordinates()[0][1], force, slider]);
    }
    assert_eq!(state.stop(), None);
    motion
}

/// Distance from the middle at the first turning points after the release, half a cycle of `half_s` apart.
fn peaks(motion: &[[f64; 3]], half_s: f64, count: usize) -> Vec<f64> {
    let ticks = half_s / 0.25e-3;
    let peak = |number: usize| {
        // A tenth of a half cycle before and after the turning point.
        let first = ((number as f64 + 0.9) * ticks) as usize;
        let around = motion.iter().skip(first).take((0.2 * ticks) as usize);
        around.map(|[z, ..]| z.abs()).fold(0.0, f64::max)
    };
    (0..count).map(peak).collect()
}

/// Half peaks fall by `2 Fd/k` (Lorenz 1924). With the spring `ks` in series, energy gives the next peak `b` after `a`:
/// `k (a^2 - b^2)/2` is the work `Fd (a + b) - 2 Fd^2/ks` of the slider, in the first half cycle, which starts
/// without force, `Fd (a + b) - Fd^2/(2 ks)`.
#[test]
fn half_peaks_fall_by_equal_amounts_until_the_slider_sticks() {
    let (friction, start) = (1e3, 10.5e-3);
    let half = std::f64::consts::PI * (MASS_KG / SPRINGS).sqrt();
    let motion = released(&suspended(friction, None, false), start, 6.5 * half);
    let found = peaks(&motion, half, 5);
    let mut peak = start;
    for (number, found) in found.iter().enumerate() {
        let stored = friction * friction / SERIES * if number == 0 { 0.5 } else { 2.0 };
        let rest = friction * peak - stored - 0.5 * SPRINGS * peak * peak;
        let next = ((friction * friction - 2.0 * SPRINGS * rest).sqrt() - friction) / SPRINGS;
        assert!((found - next).abs() < 1e-6, "{number}: {found} for {next}");
        let rigid = start - 2e-3 * (number + 1) as f64;
        assert!(
            (found - rigid).abs() < 4e-6,
            "{number}: {found} for {rigid}"
        );
        peak = next;
    }
    // It stops at the first turning point within Fd/k, at -0.5 mm, but for the spring in series.
    let last = &motion[(5.1 * half / 0.25e-3) as usize..];
    for [z, force, slider] in last {
        assert!((z + 0.5e-3).abs() < 2.5 * friction / SERIES, "{z}");
        assert!(force.abs() <= friction);
        assert_eq!(slider.to_bits(), last[0][2].to_bits());
    }
    // Until then, the force is exactly its limit whenever the slider moves.
    for pair in motion.windows(2) {
        let [[_, _, before], [_, force, after]] = [pair[0], pair[1]];
        assert!(force.abs() <= friction);
        assert!(before == after || force.abs() == friction, "{force}");
    }
}

/// While the body moves down the load of a spring and with it the friction grows: the motion is that of a mass on
/// `k + mu k1` about `-mu N/(k + mu k1)`, and on `k - mu k1` about `mu N/(k - mu k1)` while it moves up.
#[test]
fn friction_follows_the_load_of_a_spring() {
    let (coefficient, start) = (0.04, 30e-3);
    let own = 0.25 * SPRINGS;
    let standing = 0.25 * MASS_KG * GRAVITY_M_PER_S2;
    let centre = |sign: f64| -sign * coefficient * standing / (SPRINGS + sign * coefficient * own);
    let half = std::f64::consts::PI * (MASS_KG / SPRINGS).sqrt();
    for upside_down in [false, true] {
        let load = FrictionLoad::new(coefficient, "body spring 1 -1");
        let motion = released(&suspended(0.0, Some(load), upside_down), start, 6.0 * half);
        let mut peak = start;
        for found in peaks(&motion, half, 5) {
            // The body moves down from a peak above the middle.
            peak = 2.0 * centre(-peak.signum()) - peak;
            assert!((found - peak.abs()).abs() < 8e-6, "{found} for {peak}");
        }
        for pair in motion.windows(2) {
            let [[_, _, before], [z, force, after]] = [pair[0], pair[1]];
            let limit = coefficient * (standing + own * z);
            // The position is the one predicted for the tick.
            let is_limit = (force.abs() - limit).abs() < 1e-3;
            assert!(before == after || is_limit, "{force} {limit}");
        }
    }
}

/// In the linear equations the slider sticks, but the springs alone carry the weight.
#[test]
fn the_slider_sticks_in_the_linear_equations() {
    let vehicle = suspended(1e3, None, false);
    let standstill = Standstill::new(&vehicle).unwrap();
    let sunk = standstill.displacements(0)[1];
    assert!((sunk / (MASS_KG * GRAVITY_M_PER_S2 / SPRINGS) - 1.0).abs() < 1e-9);
    let greatest = |vehicle: &VehicleParameters| {
        let modes = Standstill::new(vehicle).unwrap().modes().unwrap();
        let hz = modes.iter().map(|mode| mode.undamped_hz());
        hz.fold(0.0, f64::max) * std::f64::consts::TAU
    };
    let bounce = ((SPRINGS + SERIES) / MASS_KG).sqrt();
    assert!((greatest(&vehicle) / bounce - 1.0).abs() < 1e-9);
    // Without friction, nothing sticks.
    assert!(greatest(&suspended(0.0, None, false)) < 0.1 * bounce);
}

#[test]
fn friction_needs_a_spring_that_carries_weight_and_a_tick_that_follows_it() {
    let refused = |load: &str, change: &dyn Fn(&mut VehicleParameters)| {
        let mut vehicle = suspended(0.0, Some(FrictionLoad::new(0.1, load)), false);
        change(&mut vehicle);
        Standstill::new(&vehicle).unwrap_err().to_string()
    };
    assert_eq!(
        refused("spring", &|_| ()),
        "friction: friction follows the load of spring, which is not a spring with vertical stiffness; allowed: body \
         spring 1 1, body spring 1 -1, body spring -1 1, body spring -1 -1"
    );
    // The second body stands on another spring, so the spring between the bodies carries no weight.
    let idle = |vehicle: &mut VehicleParameters| {
        let on_both = |name: &str, from: End, stiffness: f64| {
            let at = [0.0, 0.0, 1.5];
            let ends = [from, End::body("second", at)];
            let law = Law::Bush {
                stiffness_n_per_m: [stiffness; 3],
                damping_n_s_per_m: [0.0; 3],
                stiffness_n_m_per_rad: [1e6; 3],
                damping_n_m_s_per_rad: [0.0; 3],
            };
            Element::new(name, ends, law)
        };
        let second = Body::new("second", MASS_KG, [20e3, 200e3, 200e3], 1.5);
        vehicle.bodies.push(second);
        let at = [0.0, 0.0, 1.5];
        vehicle.elements.extend([
            on_both("support", End::track(at), SPRINGS),
            on_both("idle", End::body("body", at), 1e6),
        ]);
    };
    assert_eq!(
        refused("idle", &idle),
        "friction: friction follows the load of idle, which carries no load at standstill, allowed: a spring that \
         carries weight"
    );
    let negative = Standstill::new(&suspended(-1.0, None, false)).unwrap_err();
    assert_eq!(
        negative.to_string(),
        "friction: friction_n = -1, allowed: 0 to 100000000"
    );
    assert!(Vehicle::new(&suspended(1e3, None, false), contact(0.0), 2e-3).is_ok());
    let mut stiff = suspended(1e3, None, false);
    if let Law::Friction {
        stiffness_n_per_m, ..
    } = &mut stiff.elements[4].law
    {
        *stiffness_n_per_m = 1e11;
    }
    let error = Vehicle::new(&stiff, contact(0.0), 1e-3).unwrap_err();
    assert!(
        matches!(error, VehicleError::FrictionTooStiff { .. }),
        "{error}"
    );
}
