//! The contract for bad values: input, output, tiny states, invalid parameters, live changes.

use dashpot::damper;
use dashpot_core::{Damper, DamperParameters, DamperState, Real, Status, step_bank};
use dashpot_files::damper;

const STEP_S: f64 = 1e-3;
const PRESETS: [&str; 5] = [
    "paper",
    "calibrated",
    "reduced-vertical",
    "reduced-lateral",
    "in-service",
];

fn build<T: Real>(preset: &str) -> Damper<T> {
    damper(preset, &[]).build(STEP_S).expect("a preset")
}

#[test]
fn non_finite_input_is_held_latched_and_counted() {
    for preset in PRESETS {
        let damper: Damper<f32> = build(preset);
        let (mut state, mut held) = (damper.at_rest(0.0), damper.at_rest(0.0));
        let good = |tick: u32| 1e-4 * tick as f32;
        for tick in 0..50 {
            damper.step(&mut state, good(tick));
            damper.step(&mut held, good(tick));
        }
        assert_eq!(state.status().bits() & Status::INPUT_HELD.bits(), 0);
        for (count, bad) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -f32::NAN]
            .into_iter()
            .enumerate()
        {
            let force = damper.step(&mut state, bad);
            assert_eq!(
                force,
                damper.step(&mut held, good(49)),
                "{preset}: as if held"
            );
            assert_eq!(usize::from(state.rejected_inputs()), count + 1);
            assert!(state.status().contains(Status::INPUT_HELD));
            assert!(!state.status().contains(Status::INPUT_LIMITED));
        }
        damper.step(&mut state, good(50));
        assert!(state.status().contains(Status::INPUT_HELD), "latched");
        state.clear_status();
        damper.step(&mut state, good(51));
        assert!(!state.status().contains(Status::INPUT_HELD));
        assert_eq!(state.rejected_inputs(), 0);
    }
}

#[test]
fn the_counter_of_bad_input_stops_at_its_end() {
    let damper: Damper<f32> = build("paper");
    let mut state = damper.at_rest(0.0);
    for _ in 0..70_000 {
        damper.step(&mut state, f32::NAN);
    }
    assert_eq!(state.rejected_inputs(), u16::MAX);
}

#[test]
fn a_jump_is_followed_at_the_configured_rate() {
    let parameters = damper("paper", &["limits.rate_m_per_s=1.5"]);
    let damper: Damper<f64> = parameters.build(STEP_S).expect("a valid damper");
    let mut state = damper.at_rest(0.0);
    damper.step(&mut state, 1e-3);
    assert_eq!(state.status(), Status::empty());
    for tick in 1..=8 {
        damper.step(&mut state, -0.012);
        let expected = (1e-3 - 1.5e-3 * f64::from(tick)).max(-0.012);
        assert!((state.displacement_m() - expected).abs() < 1e-12);
    }
    assert!(state.status().contains(Status::INPUT_LIMITED));
    assert!(!state.status().contains(Status::INPUT_HELD));
    assert_eq!(state.rejected_inputs(), 8);
}

/// Next number of a random 32-bit sequence (xorshift, Marsaglia 2003).
fn bits(seed: &mut u32) -> u32 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    *seed
}

#[test]
fn the_force_is_finite_and_within_its_limit_for_any_bits() {
    let mut seed = 0x9e37_79b9;
    for preset in PRESETS {
        let damper: Damper<f32> = build(preset);
        let limit = damper.force_limit_n();
        let mut state = damper.at_rest(0.0);
        for tick in 0..1_000_000_u32 {
            let random = bits(&mut seed);
            // Arbitrary bits alternate with plausible magnitudes, which get further through the step.
            let x = if tick & 1024 == 0 {
                f32::from_bits(random)
            } else {
                f32::from_bits(0x3000_0000 | (random & 0x8fff_ffff))
            };
            let force = damper.step(&mut state, x);
            assert!(force.abs() <= limit, "{preset}, tick {tick}: {force}");
            assert!(state.piston_displacement_m().is_finite());
        }
    }
}

#[test]
fn any_start_position_is_safe() {
    let mut seed = 1;
    let damper: Damper<f32> = build("paper");
    for _ in 0..200_000 {
        let mut state = damper.at_rest(f32::from_bits(bits(&mut seed)));
        assert!(state.displacement_m().is_finite());
        let force = damper.step(&mut state, f32::from_bits(bits(&mut seed)));
        assert!(force.abs() <= damper.force_limit_n());
    }
}

/// Every value of a state, from its debug text.
fn numbers<T: Real>(state: &DamperState<T>) -> Vec<f64> {
    let text = format!("{state:?}");
    text.split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c)))
        .filter_map(|word| word.parse().ok())
        .collect()
}

#[test]
fn tiny_states_are_flushed() {
    for preset in PRESETS {
        let damper: Damper<f32> = build(preset);
        let mut state = damper.at_rest(0.0);
        for tick in 0..5000 {
            let x = if tick < 100 { 1e-4 * tick as f32 } else { 0.01 };
            damper.step(&mut state, x);
            let seen = numbers(&state);
            assert!(seen.len() >= 5, "the state's text has its numbers");
            for number in seen {
                let subnormal = number != 0.0 && number.abs() < f64::from(f32::MIN_POSITIVE);
                assert!(!subnormal, "{preset}, tick {tick}: {state:?}");
            }
        }
        // Seal friction holds a force up to its own size. Apart from that, an `f32` stretch resolves 6e-11 m at half a
        // millimetre of clearance, which is 5e-4 N.
        let held = if preset == "in-service" { 100.0 } else { 0.0 };
        let rest = state.force_n().abs();
        assert!(rest < held + 0.01, "{preset}: {rest} N at rest");
    }
}

#[test]
fn tiny_input_leaves_no_tiny_state() {
    let damper: Damper<f32> = build("paper");
    let mut state = damper.at_rest(0.0);
    for x in [1e-40, -1e-42, f32::MIN_POSITIVE, 1e-30, -1e-20, 1e-12] {
        assert_eq!(damper.step(&mut state, x), 0.0);
        assert_eq!(
            state.displacement_m(),
            0.0,
            "{x:e} is below the position grid"
        );
    }
}

#[test]
fn nonsense_is_refused_with_the_field_and_its_range() {
    let cases = [
        (
            "paper",
            "geometry.piston_diameter_m=-0.07",
            "geometry.piston_diameter_m",
            "1e-3 to 1 m",
        ),
        (
            "paper",
            "geometry.rod_diameter_m=0.08",
            "geometry.rod_diameter_m",
            "0.95 of piston_diameter_m",
        ),
        (
            "paper",
            "orifice.diameter_m=-1e-3",
            "orifice.diameter_m",
            "at least 0 and below piston_diameter_m",
        ),
        (
            "paper",
            "orifice.discharge_coefficient=1.5",
            "orifice.discharge_coefficient",
            "0 to 1",
        ),
        (
            "paper",
            "valves.piston_extension.clamp_radius_m=0.029",
            "valves.piston_extension.clamp_radius_m",
            "below free_radius_m",
        ),
        (
            "paper",
            "valves.foot_compression.free_radius_m=0.0",
            "valves.foot_compression.free_radius_m",
            "above 0",
        ),
        (
            "paper",
            "valves.piston_compression.preload_pa=-1.0",
            "valves.piston_compression.preload_pa",
            "0 to 1e8 Pa",
        ),
        (
            "paper",
            "valves.piston_extension.edge_compliance_m_per_pa=-1e-12",
            "valves.piston_extension.edge_compliance_m_per_pa",
            "0 to 1e-6 m/Pa",
        ),
        (
            "paper",
            "mount.stiffness_n_per_m=0.0",
            "mount.stiffness_n_per_m",
            "1e4 to 1e12 N/m",
        ),
        (
            "paper",
            "mount.stiffness_n_per_m=-8e6",
            "mount.stiffness_n_per_m",
            "1e4 to 1e12 N/m",
        ),
        (
            "paper",
            "mount.stiffness_n_per_m=nan",
            "mount.stiffness_n_per_m",
            "1e4 to 1e12 N/m",
        ),
        (
            "paper",
            "mount.clearance_m=-1e-3",
            "mount.clearance_m",
            "0 to 0.1 m",
        ),
        (
            "paper",
            "mount.clearance_m=inf",
            "mount.clearance_m",
            "0 to 0.1 m",
        ),
        (
            "paper",
            "limits.force_n=0.0",
            "limits.force_n",
            "1 to 1e7 N",
        ),
        (
            "paper",
            "limits.rate_m_per_s=-2.0",
            "limits.rate_m_per_s",
            "1e-3 to 100 m/s",
        ),
        (
            "paper",
            "limits.displacement_m=1.0",
            "limits.displacement_m",
            "1e-3 to 0.7 m",
        ),
        (
            "paper",
            "oil.density_kg_per_m3=0.0",
            "oil.density_kg_per_m3",
            "500 to 2000 kg/m3",
        ),
        (
            "in-service",
            "oil.column.air_fraction=1.2",
            "oil.column.air_fraction",
            "0 to 0.2",
        ),
        (
            "in-service",
            "oil.column.polytropic_exponent=0.5",
            "oil.column.polytropic_exponent",
            "1 to 1.67",
        ),
        (
            "in-service",
            "leakage.radial_clearance_m=-1e-5",
            "leakage.radial_clearance_m",
            "0 to 1e-3 m",
        ),
        (
            "in-service",
            "relief.opening_pressure_pa=-1.0",
            "relief.opening_pressure_pa",
            "0 to 1e8 Pa",
        ),
        (
            "in-service",
            "reservoir.gas_volume_m3=0.0",
            "reservoir.gas_volume_m3",
            "1e-6 to 1 m3",
        ),
        (
            "in-service",
            "seal.friction_n=-1.0",
            "seal.friction_n",
            "0 to 1e4 N",
        ),
        (
            "in-service",
            "two_chamber.vapour_pressure_pa=1.0",
            "two_chamber.vapour_pressure_pa",
            "-101325 to 0 Pa",
        ),
        (
            "reduced-vertical",
            "reduced.damping_n_s_per_m=0.0",
            "reduced.damping_n_s_per_m",
            "1 to 1e9 N s/m",
        ),
        (
            "reduced-vertical",
            "reduced.saturation_velocity_m_per_s=-0.03",
            "reduced.saturation_velocity_m_per_s",
            "1e-6 to 100 m/s",
        ),
    ];
    for (preset, set, field, allowed) in cases {
        let message = damper::load(preset, &[set.to_owned()])
            .expect_err(set)
            .to_string();
        assert!(message.contains(field), "{set}: {message}");
        assert!(message.contains(allowed), "{set}: {message}");
    }
}

#[test]
fn an_invalid_step_is_refused() {
    for step_s in [0.0, -1e-3, 1e-7, 1.0, f64::NAN, f64::INFINITY] {
        let error = damper("paper", &[])
            .build::<f32>(step_s)
            .expect_err("no such step");
        assert_eq!(error.field, "step_s");
        assert!(error.to_string().contains("1e-6 to 2e-2 s"), "{error}");
    }
}

#[test]
fn an_unknown_key_is_refused_with_the_nearest_one() {
    for (set, nearest) in [
        ("mount.stifness_n_per_m=6e6", "`stiffness_n_per_m`"),
        ("orifice.diametre_m=2e-3", "`diameter_m`"),
        (
            "valves.piston_extention.preload_pa=0.0",
            "`piston_extension`",
        ),
        ("oil.column.air_fractoin=0.0", "`air_fraction`"),
        ("lekage.length_m=0.03", "`leakage`"),
    ] {
        let message = damper::load("in-service", &[set.to_owned()])
            .expect_err(set)
            .to_string();
        assert!(
            message.contains(&format!("did you mean {nearest}")),
            "{set}: {message}"
        );
    }
}

#[test]
fn changes_under_a_running_state_leave_the_force_continuous() {
    let changes: [(&str, &[&str], &[&str]); 4] = [
        ("paper", &[], &["mount.clearance_m=2e-3"]),
        ("paper", &[], &["mount.stiffness_n_per_m=3e6"]),
        ("in-service", &[], &["oil.temperature_c=90.0"]),
        ("in-service", &[], &["oil.column.air_fraction=0.05"]),
    ];
    for (preset, before, after) in changes {
        let (before, after) = (damper(preset, before), damper(preset, after));
        let drops = [1e-3, 1e-4, 1e-5].map(|step_s| drop_at_swap(&before, &after, step_s));
        // The force drops because the held spring relaxes within a step, so the drop shrinks with the step.
        assert!(drops[0] < 0.25, "{after:?}: {drops:?}");
        assert!(
            drops[1] < 0.2 * drops[0] && drops[2] < 0.2 * drops[1],
            "{after:?}: {drops:?}"
        );
    }
}

/// Change of the force over the tick of a swap, relative to the force, with the displacement held.
fn drop_at_swap(before: &DamperParameters, after: &DamperParameters, step_s: f64) -> f64 {
    let (before, after): (Damper<f64>, Damper<f64>) = (
        before.build(step_s).expect("a valid damper"),
        after.build(step_s).expect("a valid damper"),
    );
    let mut state = before.at_rest(0.0);
    let ticks = (0.1 / step_s).round() as u32;
    let x = |tick: u32| 0.1 * step_s * f64::from(tick);
    for tick in 1..=ticks {
        before.step(&mut state, x(tick));
    }
    let force = state.force_n();
    assert!(force > 5e3);
    assert!(!state.status().contains(Status::DAMPER_SWAPPED));
    let swapped = after.step(&mut state, x(ticks));
    assert!(state.status().contains(Status::DAMPER_SWAPPED));
    (swapped - force).abs() / force
}

#[test]
fn adopting_keeps_force_and_displacement() {
    let before: Damper<f32> = build("paper");
    let after: Damper<f32> = build("in-service");
    let mut state = before.at_rest(0.0);
    for tick in 1..=100 {
        before.step(&mut state, -1e-4 * tick as f32);
    }
    let saved = state;
    after.adopt(&mut state);
    assert_eq!(state.force_n(), saved.force_n());
    assert_eq!(state.displacement_m(), saved.displacement_m());
    assert!(state.status().contains(Status::DAMPER_SWAPPED));
    let mut swapped = saved;
    assert_eq!(
        after.step(&mut state, -1.01e-2),
        after.step(&mut swapped, -1.01e-2),
        "adopted ahead or met in the step"
    );
}

#[test]
fn the_clearance_is_set_without_a_rebuild() {
    let mut damper: Damper<f64> = build("reduced-vertical");
    let built: Damper<f64> = self::damper("reduced-vertical", &["mount.clearance_m=2e-3"])
        .build(STEP_S)
        .expect("a valid damper");
    let revision = damper.revision();
    assert_eq!(damper.set_clearance_m(2e-3), Ok(()));
    assert_ne!(damper.revision(), revision);
    assert_eq!(damper, built, "the same damper, revision and all");
    for refused in [f64::NAN, -1.0, f64::INFINITY, 5.0] {
        assert!(damper.set_clearance_m(refused).is_err());
        assert_eq!(damper, built, "as it was");
    }
    for allowed in [0.0, 0.1] {
        assert_eq!(damper.set_clearance_m(allowed), Ok(()));
        assert_eq!(damper.clearance_m(), allowed);
    }
}

#[test]
fn a_force_from_constants_that_overflow_is_the_limit() {
    let sound: Damper<f32> = build("in-service");
    let words = sound.to_words();
    let mut huge = words;
    // The table comes after the scalars and the two revisions.
    for word in &mut huge[13..] {
        *word = f32::MAX.to_bits();
    }
    let damper = Damper::<f32>::from_words(&huge);
    let bank = [&damper; 8];
    let mut states = [damper.at_rest(0.0); 8];
    let mut alone = states[0];
    let mut forces = [0.0; 8];
    for tick in 1..100 {
        let x = 1e-3 * (0.1 * tick as f32).sin();
        let force = damper.step(&mut alone, x);
        step_bank(&bank, &mut states, &[x; 8], &mut forces);
        assert!(force.abs() <= damper.force_limit_n(), "{force}");
        assert!(forces.iter().all(|bank| bank.to_bits() == force.to_bits()));
    }
}

#[test]
fn a_start_far_out_does_not_stretch_a_damper_at_rest() {
    let damper: Damper<f32> = build("in-service");
    let mut state = damper.at_rest(1e6);
    assert_eq!(state.status(), Status::INPUT_HELD);
    for _ in 0..100 {
        assert_eq!(damper.step(&mut state, 0.0), 0.0);
    }
    assert_eq!(state.status(), Status::INPUT_HELD | Status::RESTARTED);
    // The two rejected inputs are the first displacement and that of the tick of the restart.
    assert_eq!((state.rejected_inputs(), state.displacement_m()), (2, 0.0));
}
