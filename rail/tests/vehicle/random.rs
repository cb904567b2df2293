//! Random vehicles: their modes are found, and passive motion does not grow.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{Body, Direction, Element, End, Law, Standstill, VehicleParameters};
use proptest::prelude::*;

/// A number from `min` over `decades` powers of ten, evenly distributed in the logarithm.
fn decades(min: f64, decades: f64) -> impl Strategy<Value = f64> {
    (0.0..decades).prop_map(move |exponent| min * 10f64.powf(exponent))
}

fn body(name: &'static str) -> impl Strategy<Value = Body> {
    (
        decades(100.0, 3.0),
        [0.3..3.0, 0.5..30.0, 0.5..30.0_f64],
        -3.0..3.0,
        0.3..3.0,
    )
        .prop_map(move |(mass_kg, radii_squared, x_m, height_m)| {
            let inertia_kg_m2 = radii_squared.map(|square| square * mass_kg);
            Body::new(name, mass_kg, inertia_kg_m2, height_m).with_x_m(x_m)
        })
}

fn spring(
    name: String,
    from: Option<&'static str>,
    to: &'static str,
) -> impl Strategy<Value = Element> {
    let three = |min| [decades(min, 4.0), decades(min, 4.0), decades(min, 4.0)];
    let at = (-8.0..8.0, -2.0..2.0, 0.0..3.0);
    (at, three(1e5), three(1e2)).prop_map(move |((x, y, height), stiffness, damping)| {
        let at_m = [x, y, height];
        let first = from.map_or_else(|| End::track(at_m), |on| End::body(on, at_m));
        let law = Law::SpringDamper {
            stiffness_n_per_m: stiffness,
            damping_n_s_per_m: damping,
        };
        Element::new(name.clone(), [first, End::body(to, at_m)], law)
    })
}

prop_compose! {
    fn vehicle()(
        upper in body("upper"),
        lower in body("lower"),
        springs in [
            spring("a".into(), None, "lower"), spring("b".into(), None, "lower"),
            spring("c".into(), None, "lower"), spring("d".into(), Some("lower"), "upper"),
            spring("e".into(), Some("lower"), "upper"), spring("f".into(), Some("lower"), "upper"),
        ],
        damping in decades(1.0, 8.0),
        stiffness in decades(1e4, 8.0),
    ) -> VehicleParameters {
        let mut elements = springs.to_vec();
        let law = Law::Damper {
            direction: Direction::Lateral,
            parameters: Box::new(DamperParameters::reduced(damping, 1.0, Mount::new(stiffness))),
        };
        let ends = [End::body("lower", [1.0, 0.5, 0.7]), End::body("upper", [1.0, 0.5, 0.7])];
        elements.push(Element::new("damper", ends, law));
        VehicleParameters::new("any").with_bodies([upper, lower]).with_elements(elements)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn modes_are_found_and_decay(vehicle in vehicle()) {
        // A body beside its springs is either rejected, or falls over without oscillating.
        let Ok(standstill) = Standstill::new(&vehicle) else { return Ok(()) };
        let modes = standstill.modes().unwrap();
        prop_assert!(modes.len() <= 10);
        for mode in &modes {
            prop_assert!(mode.undamped_hz().is_finite() && mode.undamped_hz() > 0.0);
            prop_assert!(mode.damping_ratio() > -1e-6, "{} {}", mode.description(), mode.damping_ratio());
            prop_assert!(mode.damping_ratio() <= 1.0);
        }
    }
}
