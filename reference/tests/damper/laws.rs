//! Compares the reference with closed forms and printed values.

use std::f64::consts::PI;

use dashpot_core::DamperParameters;
use dashpot_core::parameters::{Element, Hydraulics, TwoChamber};
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::nrmse;

use crate::common::{dampers, motions};

fn hydraulics(parameters: &mut DamperParameters) -> &mut Hydraulics {
    match &mut parameters.element {
        Element::Physical(hydraulics) => hydraulics,
        _ => unreachable!("a physical damper"),
    }
}

fn forces(parameters: &DamperParameters, (times, x): &motions::Motion) -> Vec<f64> {
    Reference::new(parameters)
        .expect("laws")
        .forces(times, x)
        .expect("forces")
}

/// Force after 1 s at constant velocity (N).
fn settled(parameters: &DamperParameters, velocity: f64) -> f64 {
    let motion = motions::sampled(100.0, 1.0, |t| velocity * t);
    *forces(parameters, &motion).last().expect("samples")
}

/// Equation 31 with the published compliances, evaluated by hand to the newton.
#[test]
fn paper_forces_at_constant_velocity() {
    for (velocity, force) in [
        (0.1, 11_824.0),
        (0.3, 36_145.0),
        (0.05, 4_724.0),
        (-0.1, -16_638.0),
        (-0.05, -7_073.0),
    ] {
        let ours = settled(&dampers::paper(), velocity);
        assert!((ours - force).abs() < 0.5, "{velocity} m/s: {ours} N");
        let law = Reference::new(&dampers::paper())
            .expect("laws")
            .static_force(velocity);
        assert!((law - force).abs() < 0.5, "{velocity} m/s: {law} N");
    }
}

/// Compares all in-service terms with values of the same laws that were computed independently in another language, by
/// bisection until the flow matches the velocity.
#[test]
fn in_service_forces_at_constant_velocity() {
    for (two_chamber, velocity, force) in [
        (false, 0.02, 1_261.375_000_957_893_7),
        (false, 0.1, 12_300.566_174_812_384),
        (false, 0.2, 17_844.151_395_408_306),
        (false, -0.02, -2_002.254_723_436_503),
        (false, -0.1, -17_170.829_311_866_02),
        (false, -0.2, -22_094.550_329_091_468),
        (true, 0.1, 12_300.566_174_812_384),
        (true, -0.02, -3_226.062_009_342_788),
        (true, -0.1, -18_105.562_655_141_766),
        (true, -0.2, -26_530.797_359_279_855),
    ] {
        let ours = settled(&dampers::in_service(two_chamber), velocity);
        assert!(
            (ours / force - 1.0).abs() < 1e-8,
            "{two_chamber} {velocity} m/s: {ours} N"
        );
    }
}

/// Two chambers without preload: `P_1 = (A_rod v/kappa)^(2/3)`, and the drop follows from the
/// piston's flow. With a wide foot valve the rod side boils and `F = P_1 A_comp - p_vap A_ext`.
#[test]
fn two_chambers_balance() {
    let (rod, whole) = (PI * 0.028_f64.powi(2) / 4.0, PI * 0.0698_f64.powi(2) / 4.0);
    let annulus = whole - rod;
    let root = (2.0_f64 / 860.0).sqrt();
    let piston = |drop: f64| {
        root * drop.sqrt() * 0.72 * PI * 0.002_f64.powi(2) / 4.0
            + root * drop.powf(1.5) * 0.61 * 2.0 * PI * 0.029 * 1.37e-11 * 0.2
    };
    let foot = root * 0.61 * 2.0 * PI * 0.011 * 1.446e-12 * 0.8265;
    let mut parameters = dampers::paper();
    hydraulics(&mut parameters).two_chamber = Some(TwoChamber::new(-0.9e5));
    for drop in [0.1e6, 1e6, 3e6] {
        let velocity = piston(drop) / annulus;
        let upstream = (rod * velocity / foot).powf(2.0 / 3.0);
        assert!(upstream - drop > -0.9e5, "not boiling");
        let force = upstream * whole - (upstream - drop) * annulus;
        let ours = -settled(&parameters, -velocity);
        assert!((ours / force - 1.0).abs() < 1e-8, "{ours} N, {force} N");
    }
    let wide = 40.0;
    hydraulics(&mut parameters)
        .valves
        .foot_compression
        .equivalent_pressure_factor *= wide;
    for upstream in [0.5e6, 2e6] {
        let through_foot = wide * foot * f64::powf(upstream, 1.5);
        let velocity = (piston(upstream + 0.9e5) + through_foot) / whole;
        let force = upstream * whole + 0.9e5 * annulus;
        let ours = -settled(&parameters, -velocity);
        assert!((ours / force - 1.0).abs() < 1e-8, "{ours} N, {force} N");
    }
}

/// In a sawtooth motion the force settles at the static force of each direction.
#[test]
fn saw_settles_on_each_leg() {
    let velocity = 0.05;
    // Legs of 0.5 s; the springs take up at most 2 mm of the 25 mm.
    let motion = motions::sampled(1e3, 2.0, |t| {
        let phase = t.fract();
        velocity * if phase < 0.5 { phase } else { 1.0 - phase }
    });
    let force = forces(&dampers::paper(), &motion);
    for leg in 0..4 {
        let expected = if leg % 2 == 0 { 4_724.0 } else { -7_073.0 };
        let ours = force[500 * (leg + 1)];
        assert!((ours - expected).abs() < 0.5, "leg {leg}: {ours} N");
    }
}

/// Spring and damper in series: stiffness `K (w tau)^2/(1 + (w tau)^2)` in phase with the displacement and damping
/// `C/(1 + (w tau)^2)` in phase with the velocity.
#[test]
fn maxwell_element_under_harmonic_motion() {
    let (damping, stiffness) = (120e3, 8e6);
    let parameters = dampers::reduced(damping, 1e3, stiffness, 0.0);
    let tau = damping / stiffness;
    for frequency in [1.0, 10.0, 50.0] {
        let (omega, per_cycle, amplitude) = (2.0 * PI * frequency, 5000, 1e-3);
        let rate = per_cycle as f64 * frequency;
        // After these cycles the initial transient has decayed to 1e-9.
        let cycles = (20.7 * tau * frequency).ceil() + 1.0;
        let (times, x) =
            motions::sampled(rate, cycles / frequency, |t| amplitude * (omega * t).sin());
        let force = forces(&parameters, &(times.clone(), x));
        let (mut sine, mut cosine) = (0.0, 0.0);
        for i in times.len() - per_cycle..times.len() {
            sine += force[i] * (omega * times[i]).sin();
            cosine += force[i] * (omega * times[i]).cos();
        }
        let scale = 2.0 / (per_cycle as f64 * amplitude);
        let ratio = (omega * tau).powi(2);
        let in_phase = stiffness * ratio / (1.0 + ratio);
        let dynamic = damping / (1.0 + ratio);
        // Linear interpolation at w dt = 2 pi/5000 weakens the harmonic by (w dt)^2/12. Frequencies above the sampling
        // rate, at which the element acts as a spring, alias and add an error of the same size.
        let allowed = stiffness * (2.0 * PI / per_cycle as f64).powi(2) / 6.0;
        let (k, c) = (scale * sine, scale * cosine / omega);
        assert!((k - in_phase).abs() < allowed, "{frequency} Hz: {k} N/m");
        assert!(
            (c - dynamic).abs() * omega < allowed,
            "{frequency} Hz: {c} N s/m"
        );
    }
}

/// Spring and damper in series under a piecewise linear motion: the force is exponential between corners.
#[test]
fn maxwell_element_between_corners() {
    let (damping, stiffness) = (90e3, 7e6);
    let motion = motions::ride(1e3, 1.0);
    let force = forces(&dampers::reduced(damping, 1e3, stiffness, 0.0), &motion);
    let mut exact = vec![0.0];
    for i in 1..force.len() {
        let dt = motion.0[i] - motion.0[i - 1];
        let terminal = damping * (motion.1[i] - motion.1[i - 1]) / dt;
        let fade = (-stiffness / damping * dt).exp();
        exact.push(terminal + (exact[i - 1] - terminal) * fade);
    }
    let difference = nrmse(&force, &exact);
    assert!(difference < 1e-9, "{difference:e}");
}

/// The force saturates at `C V_r`; at rest it decays as `exp(-K t/C)`.
#[test]
fn reduced_element_saturates_and_fades() {
    let parameters = dampers::reduced(120e3, 0.03, 8e6, 0.0);
    let force = forces(
        &parameters,
        &motions::sampled(1e3, 0.3, |t| 0.06 * t.min(0.2)),
    );
    assert_eq!(force[190], 3600.0);
    for (i, force) in force.iter().enumerate().skip(200) {
        let exact = 3600.0 * (-8e6 / 120e3 * (i as f64 * 1e-3 - 0.2)).exp();
        assert!((force - exact).abs() < 1e-6, "{i}: {force} N");
    }
}

/// At the force limit of a physical damper, the force is constant if the seats separate faster than the valves allow.
#[test]
fn physical_damper_yields_at_the_limit() {
    let mut parameters = dampers::paper();
    parameters.limits.force_n = 10e3;
    assert_eq!(settled(&parameters, 0.2), 10e3);
    assert_eq!(settled(&parameters, -0.2), -10e3);
    assert!((settled(&parameters, 0.05) - 4_724.0).abs() < 0.5);
}

/// An orifice and a spring alone: `s = sqrt(P)` falls linearly, so the force is a parabola that reaches zero at
/// `t* = 2 (A/K) s_0/q` and stays there.
#[test]
fn orifice_decays_to_exact_rest() {
    let mut parameters = dampers::paper();
    hydraulics(&mut parameters)
        .valves
        .piston_extension
        .preload_pa = 1e9;
    let motion = motions::sampled(1e3, 0.5, |t| 0.05 * t.min(0.02));
    let force = forces(&parameters, &motion);
    let annulus = PI * (0.0698_f64.powi(2) - 0.028_f64.powi(2)) / 4.0;
    let orifice = 0.72 * PI * 0.002_f64.powi(2) / 4.0 * (2.0_f64 / 860.0).sqrt() / annulus;
    let start = (force[20] / annulus).sqrt();
    let rate = orifice * 6e6 / (2.0 * annulus);
    let end = 0.02 + start / rate;
    assert!(end > 0.04 && end < 0.06, "{end} s");
    for (time, force) in motion.0.iter().zip(&force).skip(20) {
        if *time > end + 1e-6 {
            assert_eq!(*force, 0.0, "{time} s");
        } else {
            let root = start - rate * (time - 0.02);
            let exact = annulus * root * root;
            assert!((force - exact).abs() < 1e-4, "{time} s: {force} {exact}");
        }
    }
}

/// Below seal friction the piston sticks and the force is that of the springs alone.
#[test]
fn seal_friction_holds_the_piston() {
    let parameters = dampers::in_service(false);
    // The seat is 0.5 mm away; beyond it, springs of 8 and 40 MN/m in series act up to 140 N.
    let stiffness = 1.0 / (1.0 / 8e6 + 1.0 / 40e6);
    let peak = 0.5e-3 + 140.0 / stiffness;
    let motion = motions::sampled(1e3, 1.0, |t| peak * (2.0 * PI * t).sin());
    for (x, force) in motion.1.iter().zip(forces(&parameters, &motion)) {
        let exact = stiffness * (x.abs() - 0.5e-3).max(0.0).copysign(*x);
        assert!((force - exact).abs() < 1e-8, "{x} m: {force} N");
    }
}

/// A piston whose valves are closed by preload keeps the pressure at which they closed.
#[test]
fn closed_valves_hold_their_opening_pressure() {
    let mut parameters = dampers::paper();
    let inner = hydraulics(&mut parameters);
    inner.orifice.diameter_m = 0.0;
    inner.valves.piston_extension.preload_pa = 1e6;
    let force = forces(
        &parameters,
        &motions::sampled(1e3, 5.0, |t| 0.05 * t.min(0.1)),
    );
    let annulus = PI * (0.0698_f64.powi(2) - 0.028_f64.powi(2)) / 4.0;
    let held = 1e6 * annulus;
    let ours = force[5000];
    assert!((ours / held - 1.0).abs() < 1e-6, "{ours} N, {held} N");
}

#[test]
fn wrong_input_is_refused() {
    let mut reference = Reference::new(&dampers::paper()).expect("laws");
    for (times, x) in [
        (vec![0.0, 1.0], vec![0.0]),
        (vec![0.0, 0.0], vec![0.0, 1e-3]),
        (vec![0.0, 1.0], vec![0.0, f64::NAN]),
        (vec![], vec![]),
    ] {
        assert!(reference.forces(&times, &x).is_err(), "{times:?} {x:?}");
    }
    let mut rigid = dampers::paper();
    rigid.mount.stiffness_n_per_m = 0.0;
    assert!(Reference::new(&rigid).is_err());
    let mut weak = dampers::in_service(false);
    weak.limits.force_n = 100.0;
    assert!(Reference::new(&weak).is_err(), "limit below seal friction");
}
