//! Steps of a linear damper across the edges of its clearance, against exact solutions.

use crate::damper::Damper;
use crate::parameters::{DamperParameters, Mount};
use crate::stages::GAMMA;
use crate::state::DamperState;
use crate::status::Status;

const HALF_CLEARANCE_M: f64 = 0.5e-3;
const STIFFNESS_N_PER_M: f64 = 8e6;
const STEP_S: f64 = 1e-3;

/// A damper that relaxes by the share `relaxation` in a step: stiffness times step, divided by the damping.
fn damper(relaxation: f64) -> Damper<f64> {
    let mount = Mount::new(STIFFNESS_N_PER_M).clearance_m(2.0 * HALF_CLEARANCE_M);
    let damping = STEP_S * STIFFNESS_N_PER_M / relaxation;
    // The element yields at 20 kN, beyond all forces of these tests.
    DamperParameters::reduced(damping, 20e3 / damping, mount)
        .build(STEP_S)
        .expect("a valid damper")
}

/// Stretch beyond the clearance (m), with its sign.
fn beyond(stretch: f64) -> f64 {
    stretch - stretch.clamp(-HALF_CLEARANCE_M, HALF_CLEARANCE_M)
}

/// Integral of the flow of a step over the stretch beyond the clearance (m^2).
fn potential(relaxation: f64, stretch: f64) -> f64 {
    0.5 * relaxation * beyond(stretch) * beyond(stretch)
}

/// The state after a step with a travel (m) from a stretch (m).
fn stepped(relaxation: f64, stretch: f64, travel: f64) -> DamperState<f64> {
    let damper = damper(relaxation);
    let force = STIFFNESS_N_PER_M * beyond(stretch);
    let numbers = [0.0, stretch, potential(relaxation, stretch), force];
    let mut state = DamperState::new(numbers, damper.revision(), Status::empty(), 0);
    damper.step(&mut state, travel);
    assert_eq!(state.status(), Status::empty());
    state
}

/// Solves `du/dt = travel - relaxation u` for the stretch beyond the clearance (m) after a time in steps.
fn relaxed(relaxation: f64, beyond: f64, travel: f64, time: f64) -> f64 {
    let end = travel / relaxation;
    end + (beyond - end) * libm::exp(-relaxation * time)
}

#[test]
fn entering_contact_follows_the_exact_solution() {
    let relaxation = 1.0 / 15.0;
    for (stretch, travel, tolerance_m) in [(0.4e-3, 0.3e-3, 2e-9), (0.0, 2e-3, 4e-8)] {
        let inside = (HALF_CLEARANCE_M - stretch) / travel;
        let exact = relaxed(relaxation, 0.0, travel, 1.0 - inside);
        for sign in [1.0, -1.0] {
            let state = stepped(relaxation, sign * stretch, sign * travel);
            let error = sign * beyond(state.stretch) - exact;
            assert!(error.abs() < tolerance_m, "{error:e} m");
            let force = STIFFNESS_N_PER_M * beyond(state.stretch);
            assert!((state.force_n() - force).abs() < 1e-6);
            let area = potential(relaxation, state.stretch);
            assert!((state.potential / area - 1.0).abs() < 1e-3);
        }
    }
}

#[test]
fn leaving_contact_follows_the_exact_solution() {
    let relaxation = 1.0 / 15.0;
    // The last one crosses the whole clearance and ends in contact on the other side.
    for (stretch, travel, tolerance_m) in [(0.8e-3, -0.5e-3, 6e-8), (0.6e-3, -1.3e-3, 3e-8)] {
        let end = travel / relaxation;
        let contact = libm::log((beyond(stretch) - end) / -end) / relaxation;
        let free = HALF_CLEARANCE_M + travel * (1.0 - contact);
        let exact = if free < -HALF_CLEARANCE_M {
            let crossing = 2.0 * HALF_CLEARANCE_M / -travel;
            -HALF_CLEARANCE_M + relaxed(relaxation, 0.0, travel, 1.0 - contact - crossing)
        } else {
            free
        };
        for sign in [1.0, -1.0] {
            let state = stepped(relaxation, sign * stretch, sign * travel);
            let error = sign * state.stretch - exact;
            assert!(error.abs() < tolerance_m, "{error:e} m");
        }
    }
}

#[test]
fn within_contact_the_stages_alone_decide() {
    let relaxation = 1.0 / 15.0;
    for (start, travel) in [(1e-3, 0.3e-3), (0.8e-3, -0.2e-3)] {
        for sign in [1.0, -1.0] {
            // For a linear law, the scheme of L-stable order 2 multiplies the distance from the steady stretch by
            // (1 - (1 - 2 gamma) r) / (1 + gamma r)^2.
            let steady = travel / relaxation;
            let once = 1.0 + GAMMA * relaxation;
            let factor = (1.0 - (1.0 - 2.0 * GAMMA) * relaxation) / (once * once);
            let expected = steady + (beyond(start) - steady) * factor;
            let state = stepped(relaxation, sign * start, sign * travel);
            let error = sign * beyond(state.stretch) - expected;
            assert!(error.abs() < 1e-12, "{error:e} m");
        }
    }
}

#[test]
fn the_correction_is_at_most_an_eighth_of_the_change() {
    // Both corrections are larger without the bound: the first reduces the stretch, the second increases it.
    for (relaxation, stretch, travel, share) in
        [(4.0, 0.0, 2e-3, 0.125), (8.0, 0.4e-3, 1.2e-3, -0.125)]
    {
        let flow = |reach: f64| relaxation * beyond(reach) / (1.0 + GAMMA * relaxation);
        for sign in [1.0, -1.0] {
            let (start, travel) = (sign * stretch, sign * travel);
            let first = flow(start + GAMMA * travel);
            let last = flow(start + travel - (1.0 - GAMMA) * first);
            let change = travel - (1.0 - GAMMA) * first - GAMMA * last;
            let state = stepped(relaxation, start, travel);
            let error = state.stretch - (start + change - share * change);
            assert!(error.abs() < 1e-12, "{error:e} m");
        }
    }
}
