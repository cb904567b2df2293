//! Modes and equilibrium against closed forms.

use std::f64::consts::PI;

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, GRAVITY_M_PER_S2, Law, Mode, Standstill, VehicleParameters,
    Wheelset,
};

fn body(name: &str, mass_kg: f64, height_m: f64) -> Body {
    let inertia_kg_m2 = [0.8, 20.0, 21.0].map(|square| square * mass_kg);
    Body::new(name, mass_kg, inertia_kg_m2, height_m)
}

fn spring(name: &str, ends: [End; 2], stiffness: f64, damping: f64) -> Element {
    let law = Law::SpringDamper {
        stiffness_n_per_m: [stiffness; 3],
        damping_n_s_per_m: [damping; 3],
    };
    Element::new(name, ends, law)
}

/// Four springs between `from` (the track if `None`) and `to`, at +-`x_m`, +-`y_m` and `height_m`.
fn four_springs(
    from: Option<&str>,
    to: &str,
    [x_m, y_m, height_m]: [f64; 3],
    stiffness: f64,
    damping: f64,
) -> Vec<Element> {
    let mut springs = Vec::new();
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let at = [x * x_m, y * y_m, height_m];
        let first = from.map_or_else(|| End::track(at), |name| End::body(name, at));
        let name = format!("{to} spring {x} {y}");
        springs.push(spring(
            &name,
            [first, End::body(to, at)],
            stiffness,
            damping,
        ));
    }
    springs
}

fn vehicle(bodies: Vec<Body>, elements: Vec<Element>) -> VehicleParameters {
    VehicleParameters::new("test")
        .with_bodies(bodies)
        .with_elements(elements)
}

fn modes(vehicle: &VehicleParameters) -> Vec<Mode> {
    Standstill::new(vehicle).unwrap().modes().unwrap()
}

fn named<'a>(modes: &'a [Mode], words: &str) -> &'a Mode {
    let all: Vec<String> = modes.iter().map(Mode::description).collect();
    let found = all.iter().position(|name| name == words);
    &modes[found.unwrap_or_else(|| panic!("no {words} in {all:?}"))]
}

#[test]
fn a_suspended_body_bounces_pitches_and_yaws_as_in_the_textbook() {
    let (mass, stiffness, damping) = (30e3, 1e6, 20e3);
    // Springs at the height of the centre of gravity.
    let mut elements = four_springs(None, "body", [5.0, 1.1, 1.5], stiffness, damping);
    for element in &mut elements {
        // Half the lateral stiffness.
        let Law::SpringDamper {
            stiffness_n_per_m, ..
        } = &mut element.law
        else {
            unreachable!("springs");
        };
        stiffness_n_per_m[1] *= 0.5;
    }
    let modes = modes(&vehicle(vec![body("body", mass, 1.5)], elements));
    assert_eq!(modes.len(), 5);
    // Squared lever arms, weighted by stiffness and by damping. The load couples lateral and roll: see the pendulum
    // below.
    let cases = [
        ("body bounce", mass, 1.0, 1.0),
        ("body pitch", 20.0 * mass, 25.0, 25.0),
        ("body yaw", 21.0 * mass, 12.5 + 1.21, 25.0 + 1.21),
    ];
    for (words, inertia, stiff_arms, damped_arms) in cases {
        let omega = (4.0 * stiffness * stiff_arms / inertia).sqrt();
        let ratio = 4.0 * damping * damped_arms / (2.0 * omega * inertia);
        let mode = named(&modes, words);
        assert!(
            (mode.undamped_hz() * 2.0 * PI / omega - 1.0).abs() < 1e-9,
            "{words}"
        );
        assert!((mode.damping_ratio() / ratio - 1.0).abs() < 1e-9, "{words}");
        let damped = (1.0 - ratio * ratio).sqrt() * omega / (2.0 * PI);
        assert!((mode.damped_hz() / damped - 1.0).abs() < 1e-9, "{words}");
    }
}

#[test]
fn a_body_above_its_springs_sways_as_an_inverted_pendulum() {
    let (mass, stiffness, height, y) = (30e3, 1e6, 1.2, 1.0);
    let elements = four_springs(None, "body", [5.0, y, 1.5 - height], stiffness, 0.0);
    let modes = modes(&vehicle(vec![body("body", mass, 1.5)], elements));
    // The axes of the springs turn by half the roll, so their load m g along z has the lateral component m g roll/2.
    // This component also cancels half of the moment of the load on its displaced end: [m 0; 0 I] q'' + [k, -k h - w/2;
    // -k h - w/2, k (y^2 + h^2)] q = 0, with w = m g and the height h above the springs.
    let k = 4.0 * stiffness;
    let inertia = 0.8 * mass;
    let (a, b) = (k / mass, k * (y * y + height * height) / inertia);
    let c = k * height + 0.5 * mass * GRAVITY_M_PER_S2;
    let mean = 0.5 * (a + b);
    let root = (0.25 * (a - b).powi(2) + c * c / (mass * inertia)).sqrt();
    for (words, square) in [
        ("body lower sway", mean - root),
        ("body upper sway", mean + root),
    ] {
        let expected = square.sqrt() / (2.0 * PI);
        let found = named(&modes, words).undamped_hz();
        assert!(
            (found / expected - 1.0).abs() < 1e-9,
            "{words}: {found} for {expected}"
        );
    }
}

#[test]
fn a_dashpot_in_series_with_a_spring_is_a_cubic() {
    let (mass, stiffness, damping, series) = (30e3, 1e6, 60e3, 4e6);
    let mut elements = four_springs(None, "body", [5.0, 1.0, 1.5], stiffness, 0.0);
    for (number, x) in [5.0, -5.0].into_iter().enumerate() {
        let at = [x, 0.0, 1.5];
        let law = Law::Damper {
            direction: Direction::Vertical,
            parameters: Box::new(DamperParameters::reduced(damping, 1.0, Mount::new(series))),
        };
        let ends = [End::track(at), End::body("body", at)];
        elements.push(Element::new(format!("damper {number}"), ends, law));
    }
    let modes = modes(&vehicle(vec![body("body", mass, 1.5)], elements));
    let bounce = named(&modes, "body bounce");
    // The eigenvalue s satisfies m s^2 + k + 2 s c K / (K + s c) = 0.
    let (omega, ratio) = (bounce.undamped_hz() * 2.0 * PI, bounce.damping_ratio());
    let s = [-ratio * omega, omega * (1.0 - ratio * ratio).sqrt()];
    let product = |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let squared = product(s, s);
    let oscillator = [mass * squared[0] + 4.0 * stiffness, mass * squared[1]];
    let relaxed = [series + s[0] * damping, s[1] * damping];
    let left = product(oscillator, relaxed);
    let right = [2.0 * damping * series * s[0], 2.0 * damping * series * s[1]];
    let scale = 4.0 * stiffness * series;
    for k in 0..2 {
        assert!(
            (left[k] + right[k]).abs() < 1e-8 * scale,
            "{left:?} {right:?}"
        );
    }
    assert!(ratio > 0.02);
}

#[test]
fn two_masses_on_springs_have_the_frequencies_of_the_quadratic() {
    // A bogie of 6 t on 10 MN/m, a body of 30 t on 2 MN/m.
    let mut elements = four_springs(None, "bogie", [2.0, 1.0, 0.6], 2.5e6, 0.0);
    elements.extend(four_springs(
        Some("bogie"),
        "body",
        [2.0, 1.0, 1.5],
        0.5e6,
        0.0,
    ));
    let modes = modes(&vehicle(
        vec![body("body", 30e3, 1.5), body("bogie", 6e3, 0.6)],
        elements,
    ));
    let (a, b, c) = (2e6 / 30e3, 12e6 / 6e3, 2e6);
    let mean: f64 = 0.5 * (a + b);
    let root = (0.25 * (a - b) * (a - b) + c * c / (30e3 * 6e3)).sqrt();
    for (words, square) in [("body bounce", mean - root), ("bogie bounce", mean + root)] {
        let found = named(&modes, words).undamped_hz();
        assert!(
            (found / (square.sqrt() / (2.0 * PI)) - 1.0).abs() < 1e-9,
            "{words}"
        );
    }
}

#[test]
fn an_anti_roll_bar_and_a_traction_rod_add_their_stiffness() {
    let plain = four_springs(None, "body", [5.0, 1.0, 1.5], 1e6, 0.0);
    let modes_with = |element: Option<Element>| {
        let mut elements = plain.clone();
        elements.extend(element);
        modes(&vehicle(vec![body("body", 30e3, 1.5)], elements))
    };
    let bar = modes_with(Some(Element::new(
        "bar",
        [End::track([0.0; 3]), End::body("body", [0.0; 3])],
        Law::AntiRollBar {
            stiffness_n_m_per_rad: 3e6,
        },
    )));
    // The sum of all squared frequencies is the trace of stiffness over inertia, whatever the coupling.
    let trace = |modes: &[Mode]| -> f64 {
        let square = |mode: &Mode| (2.0 * PI * mode.undamped_hz()).powi(2);
        modes.iter().map(square).sum()
    };
    let added = |modes: &[Mode], expected: f64| {
        let found = trace(modes) - trace(&modes_with(None));
        assert!(
            (found / expected - 1.0).abs() < 1e-8,
            "{found} for {expected}"
        );
    };
    added(&bar, 3e6 / (0.8 * 30e3));
    // A rod along the track, 1 m beside the centre of gravity: its yaw stiffness is its stiffness times the squared
    // lever arm.
    let rod = modes_with(Some(Element::new(
        "rod",
        [
            End::track([-1.0, 1.0, 1.5]),
            End::body("body", [0.0, 1.0, 1.5]),
        ],
        Law::TractionRod {
            stiffness_n_per_m: 50e6,
            damping_n_s_per_m: 0.0,
        },
    )));
    added(&rod, 50e6 / (21.0 * 30e3));
    // A bush has a separate stiffness for each rotation.
    let bush = modes_with(Some(Element::new(
        "bush",
        [
            End::track([0.0, 0.0, 1.5]),
            End::body("body", [0.0, 0.0, 1.5]),
        ],
        Law::Bush {
            stiffness_n_per_m: [0.0, 0.0, 4e6],
            damping_n_s_per_m: [0.0; 3],
            stiffness_n_m_per_rad: [3e6, 20e6, 30e6],
            damping_n_m_s_per_rad: [0.0; 3],
        },
    )));
    let [mass, roll, pitch, yaw] = [1.0, 0.8, 20.0, 21.0].map(|square| square * 30e3);
    added(&bush, 4e6 / mass + 3e6 / roll + 20e6 / pitch + 30e6 / yaw);
}

#[test]
fn springs_give_way_under_the_weight_and_the_axles_carry_it() {
    let wheelset = |name: &str| Wheelset::new(name, 1500.0, [800.0, 100.0, 800.0], 0.46);
    // The centre of gravity is a quarter of the way from the front axle to the rear axle.
    let mut wagon = body("body", 30e3, 1.5);
    wagon.x_m = 2.0;
    let mut elements = Vec::new();
    for (axle, x) in [("front", 4.0), ("rear", -4.0)] {
        for y in [1.0, -1.0] {
            let at = [x, y, 0.46];
            let ends = [End::body(axle, at), End::body("body", at)];
            elements.push(spring(&format!("{axle} {y}"), ends, 1e6, 0.0));
        }
    }
    let vehicle = vehicle(vec![wagon], elements).with_wheelsets([
        wheelset("front").with_x_m(4.0),
        wheelset("rear").with_x_m(-4.0),
    ]);
    let standstill = Standstill::new(&vehicle).unwrap();
    let weight = 30e3 * GRAVITY_M_PER_S2;
    let of_axle = 1500.0 * GRAVITY_M_PER_S2;
    for (found, share) in standstill.axle_loads_n().iter().zip([0.75, 0.25]) {
        assert!((found - (share * weight + of_axle)).abs() < 1e-6 * weight);
    }
    let [lateral, vertical, roll, pitch, yaw] = standstill.displacements(0);
    // The front sinks by 0.75 W / (2 MN/m) and the rear, 8 m behind it, by a third of that.
    let (front, rear) = (0.75 * weight / 2e6, 0.25 * weight / 2e6);
    assert!((pitch - (rear - front) / 8.0).abs() < 1e-12);
    assert!((vertical - (front + 2.0 * pitch)).abs() < 1e-12);
    assert!(lateral.abs() + roll.abs() + yaw.abs() < 1e-12);
}
