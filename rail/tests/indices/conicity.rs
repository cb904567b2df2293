//! Rolling radius difference and equivalent conicity, compared with closed forms and an independent integration.

use dashpot_rail::contact::{Installation, Pair};
use dashpot_rail::indices::{CONTACT_DISTANCE_M, RollingRadiusDifference, RollingRadiusError};
use dashpot_rail::profile::{Profile, uic60};

const RADIUS: f64 = 0.46;

#[test]
fn a_cone_has_its_own_conicity_at_every_amplitude() {
    let cone = RollingRadiusDifference::from_fn(10e-3, 400, |y| 2.0 * 0.05 * y).unwrap();
    for amplitude in [0.2e-3, 1e-3, 3e-3, 9.9e-3] {
        let conicity = cone.equivalent_conicity(amplitude, RADIUS).unwrap();
        assert!((conicity - 0.05).abs() < 1e-6, "{conicity}");
    }
    assert_eq!(cone.equivalent_conicity(10.2e-3, RADIUS), None);
    assert_eq!(
        (cone.lateral_m().len(), cone.difference_m().len()),
        (401, 401)
    );
    assert_eq!(
        (cone.lateral_m()[0], cone.difference_m()[0]),
        (-10e-3, -1e-3)
    );
}

#[test]
fn a_shifted_cone_oscillates_about_its_own_equilibrium() {
    // The equilibrium lies between two samples.
    let cone = RollingRadiusDifference::from_fn(10e-3, 400, |y| 2.0 * 0.1 * (y - 1.31e-3)).unwrap();
    assert!((cone.rolling_line_m().unwrap() - 1.31e-3).abs() < 1e-12);
    assert!((cone.equivalent_conicity(3e-3, RADIUS).unwrap() - 0.1).abs() < 1e-6);
}

#[test]
fn a_wheelset_rolls_straight_at_the_rising_zero_nearest_to_the_centre() {
    let rolling_line_m = |difference_m: &[f64]| {
        let middle = (difference_m.len() / 2) as f64;
        let lateral = (0..difference_m.len()).map(|i| i as f64 - middle).collect();
        let samples = RollingRadiusDifference::new(lateral, difference_m.to_vec()).unwrap();
        samples.rolling_line_m()
    };
    // Three zeros: rising at -1.5 and 1.25, falling at 0.
    let three = [-1.0, -0.5, 0.5, 0.0, -0.25, 0.75, 1.0];
    assert_eq!(rolling_line_m(&three), Some(1.25));
    assert_eq!(rolling_line_m(&[2.0, 1.0, 0.5]), None);
    assert_eq!(rolling_line_m(&[-2.0, -1.0, -0.5]), None);
    // Both differences of a cell are zero: its middle.
    assert_eq!(rolling_line_m(&[0.0, 0.0]), Some(-0.5));
}

#[test]
fn a_step_has_the_wavelength_of_constant_acceleration() {
    // With a constant difference c on either side, a quarter of the wavelength is sqrt(2 A e r / c), so tan g = pi^2 c
    // / (16 A).
    let c = 0.4e-3;
    let step = RollingRadiusDifference::from_fn(10e-3, 20_000, |y| c * y.signum()).unwrap();
    for amplitude in [1e-3, 4e-3] {
        let expected = std::f64::consts::PI.powi(2) * c / (16.0 * amplitude);
        let conicity = step.equivalent_conicity(amplitude, RADIUS).unwrap();
        assert!(
            (conicity / expected - 1.0).abs() < 1e-3,
            "{conicity} {expected}"
        );
    }
}

#[test]
fn a_cubic_has_the_period_of_its_oscillator() {
    // For y'' = -k y^3 with the amplitude A, a quarter of the wavelength is 1.854074677 / (A sqrt k), from the
    // lemniscate integral.
    let k3 = 2000.0;
    let cubic = RollingRadiusDifference::from_fn(10e-3, 4000, |y| k3 * y.powi(3)).unwrap();
    let amplitude = 5e-3;
    let k = k3 / (CONTACT_DISTANCE_M * RADIUS);
    let wave = 4.0 * 1.854_074_677 / (amplitude * k.sqrt());
    let expected = 0.5 * CONTACT_DISTANCE_M * RADIUS * (std::f64::consts::TAU / wave).powi(2);
    let conicity = cubic.equivalent_conicity(amplitude, RADIUS).unwrap();
    assert!(
        (conicity / expected - 1.0).abs() < 1e-5,
        "{conicity} {expected}"
    );
}

#[test]
fn the_standard_pair_has_the_known_conicity_and_wavelength() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let rolling = RollingRadiusDifference::of(&pair, 10e-3, 1600).unwrap();
    // S1002 on UIC 60 at 1:40, 1435 mm, 1360 mm: 0.17 to 0.18 at 3 mm in the literature (0.18 with two digits).
    let conicity = rolling.equivalent_conicity(3e-3, 0.625).unwrap();
    println!("conicity at 3 mm: {conicity:.4}");
    assert!((0.165..0.185).contains(&conicity), "{conicity}");
    // Integrates the path along the track by Runge-Kutta steps.
    for amplitude in [2e-3, 3e-3, 5.5e-3] {
        let bend = |y: f64| -rolling.at(y) / (CONTACT_DISTANCE_M * 0.625);
        let (mut y, mut slope, mut x) = (-amplitude, 0.0, 0.0);
        let h = 2e-3;
        let half = loop {
            let k1 = (slope, bend(y));
            let k2 = (slope + 0.5 * h * k1.1, bend(y + 0.5 * h * k1.0));
            let k3 = (slope + 0.5 * h * k2.1, bend(y + 0.5 * h * k2.0));
            let k4 = (slope + h * k3.1, bend(y + h * k3.0));
            let next = slope + h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
            if x > 1.0 && next <= 0.0 {
                break x + h * slope / (slope - next);
            }
            y += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
            slope = next;
            x += h;
        };
        let expected = 0.5 * CONTACT_DISTANCE_M * 0.625 * (std::f64::consts::PI / half).powi(2);
        let conicity = rolling.equivalent_conicity(amplitude, 0.625).unwrap();
        assert!(
            (conicity / expected - 1.0).abs() < 2e-3,
            "{amplitude}: {conicity} {expected}"
        );
    }
    // The wheels are equal, so the difference is an odd function of the shift.
    for i in 0..=800 {
        let (a, b) = (rolling.difference_m()[i], rolling.difference_m()[1600 - i]);
        assert!((a + b).abs() < 1e-6, "{a} {b}");
    }
}

/// A cone of 1:40 with a straight flange face of 70 degrees and a round tip, sampled every 0.5 mm.
fn cone() -> Profile {
    let face = 70_f64.to_radians().tan();
    let points: Vec<[f64; 2]> = (-132..=120)
        .map(|i| f64::from(i) * 0.5)
        .map(|s| {
            let z = if s > -36.0 {
                -s / 40.0
            } else if s > -44.0 {
                0.9 - (s + 36.0) * face
            } else {
                let tip = 0.9 + 8.0 * face;
                tip + 4.0 - (s + 50.0).powi(2) * 4.0 / 36.0
            };
            [s * 1e-3, z * 1e-3]
        })
        .collect();
    Profile::through("cone", &points, 0.0).unwrap()
}

#[test]
fn a_cone_touches_the_round_head_at_the_point_of_equal_slope() {
    let installation = Installation::default().with_inclination(0.0);
    let pair = Pair::new(cone(), &uic60::profile(), installation).unwrap();
    let mut scratch = Vec::new();
    for shift in [-4e-3, -1e-3, 0.0, 2e-3, 4e-3] {
        let contact = pair.rigid_contact(shift, 0.0, &mut scratch);
        for (side, sign) in contact.sides.iter().zip([-1.0, 1.0]) {
            // The cone touches R 300 where the head has the slope of the cone, 300 sin(g) from the middle of the rail.
            let slope = (1.0_f64 / 40.0).atan() - sign * contact.roll_rad;
            let middle = 0.5 * 1.435 + 35.984e-3;
            let y = middle - 0.3 * slope.sin();
            assert!(
                (side.track_y_m - y).abs() < 0.05e-3,
                "{shift}: {} {y}",
                side.track_y_m
            );
            assert!(
                (side.slope + slope.tan()).abs() < 2e-6,
                "{shift}: {}",
                side.slope
            );
        }
        // To first order in the small angles, the radius difference of a cone is 2 g y / (1 - g R / e), where e is half
        // the distance of the contact points. This includes the shift of the points on the rail heads.
        let e = contact.sides[1].track_y_m;
        let expected = 2.0 / 40.0 * shift / (1.0 - 0.3 / 40.0 / e);
        let found = contact.rolling_radius_difference_m();
        assert!(
            (found - expected).abs() < 0.005 * expected.abs() + 1e-8,
            "{shift}: {found} {expected}"
        );
    }
}

#[test]
fn invalid_samples_are_rejected() {
    let length = RollingRadiusDifference::new(vec![0.0], vec![0.0]).unwrap_err();
    assert!(matches!(
        length,
        RollingRadiusError::Length { shifts: 1, .. }
    ));
    for (lateral_m, difference_m, wrong) in [
        (vec![0.0, 1e-3, 3e-3], vec![0.0; 3], 1),
        (vec![0.0, -1e-3, -2e-3], vec![0.0; 3], 0),
        (vec![0.0, 1e-3, 2e-3], vec![0.0, 0.0, f64::NAN], 2),
    ] {
        let error = RollingRadiusDifference::new(lateral_m, difference_m).unwrap_err();
        assert!(
            matches!(error, RollingRadiusError::Sample { index, .. } if index == wrong),
            "{error}"
        );
    }
    assert!(RollingRadiusDifference::from_fn(0.0, 10, |y| y).is_err());
    assert!(RollingRadiusDifference::from_fn(1e-3, 0, |y| y).is_err());
    let cone = RollingRadiusDifference::from_fn(10e-3, 400, |y| 0.1 * y).unwrap();
    for (amplitude_m, radius_m) in [(0.0, RADIUS), (f64::NAN, RADIUS), (3e-3, -1.0)] {
        assert_eq!(cone.equivalent_conicity(amplitude_m, radius_m), None);
    }
}
