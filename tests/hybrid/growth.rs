//! Small motion of the whole nonlinear vehicle, with one damper behind a pure delay, grows above the critical delay and
//! decays below it.

use std::collections::VecDeque;

use dashpot_core::Damper;
use dashpot_files::case::{Case, CaseOptions};
use dashpot_hybrid::plan::critical_delay;
use dashpot_rail::vehicle::{Law, Running};
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{Run, outside_index};

/// The vehicle at a speed on ideal track, pushed aside a little.
/// All dampers are without clearance.
fn case(vehicle: &str, km_h: f64) -> Case {
    let mut options = CaseOptions::load("straight-180").unwrap();
    options.set_vehicle(vehicle);
    options.set_track("ideal");
    options.set_number("speed_km_h", km_h);
    options.set_number("push_m", 1e-6);
    let mut case = options.case().unwrap();
    for element in &mut case.vehicle.elements {
        if let Law::Damper { parameters, .. } = &mut element.law {
            parameters.mount.clearance_m = 0.0;
        }
    }
    case.duration_s = SETTLING_S + 2.0 * WINDOW_S;
    case
}

/// Time for other modes to die out, and length of the windows that are compared, s.
const SETTLING_S: f64 = 3.0;
const WINDOW_S: f64 = 2.0;

/// Growth of the damper's motion from one window to the next, with its displacement `ticks` late.
fn growth(case: &Case, name: &str, ticks: usize) -> f64 {
    let index = outside_index(case, name, &[]).unwrap();
    let mut run = Run::new(case).unwrap();
    let parameters = case.damper(name).unwrap().clone().check().unwrap();
    let damper: Damper<f64> = parameters.build(case.step_s).unwrap();
    let displacement_m = |run: &Run| run.state().damper_displacements_m()[index];
    let first_m = displacement_m(&run);
    let mut state = damper.at_rest(first_m);
    // The force acts at the end of the next tick, which is one tick of the delay.
    let mut past: VecDeque<f64> = vec![first_m; ticks - 1].into();
    let mut amplitudes = [0.0_f64; 2];
    while !run.is_over() {
        assert_eq!(run.step().unwrap(), None);
        past.push_back(displacement_m(&run));
        let late_m = past.pop_front().unwrap();
        let force_n = damper.step(&mut state, late_m);
        run.state_mut()
            .set_outside_force_n(index, Some(force_n))
            .unwrap();
        let velocity = run.state().damper_velocities_m_per_s()[index];
        let time_s = run.time_s() - SETTLING_S;
        if time_s >= 0.0 {
            let window = usize::from(time_s >= WINDOW_S);
            amplitudes[window] = amplitudes[window].max(velocity.abs());
        }
    }
    println!("{name}, {ticks} ticks: {amplitudes:?}");
    amplitudes[1] / amplitudes[0]
}

fn check(vehicle: &str, km_h: f64, name: &str) {
    let mut case = case(vehicle, km_h);
    case.rails = None;
    let contacts = ContactSetup::of_case(&case).unwrap().exact().unwrap();
    let contacts: Vec<_> = contacts.iter().map(AsRef::as_ref).collect();
    let running = Running::with_contacts(&case.vehicle, &contacts, case.speed_m_per_s).unwrap();
    let index = outside_index(&case, name, &[]).unwrap();
    let plant = running.without_damper(index).unwrap().try_into().unwrap();
    let critical = critical_delay(&plant).unwrap().unwrap();
    let ticks = critical.delay_s / case.step_s;
    println!(
        "{vehicle}, {name}: critical {ticks:.2} ticks, {:.2} Hz",
        critical.frequency_hz
    );
    let below = growth(&case, name, (0.92 * ticks).floor() as usize);
    let above = growth(&case, name, (1.08 * ticks).ceil() as usize);
    println!("{vehicle}, {name}: {below:.3}, {above:.3}");
    assert!(below < 0.95, "{vehicle}, {name}: grows by {below}");
    assert!(above > 1.05, "{vehicle}, {name}: grows by {above}");
}

/// The plan has rigid rails, as the linear equations do.
#[test]
fn rails_that_give_way_change_the_delay_near_the_critical_speed() {
    let case = case("locomotive", 400.0);
    assert!(case.rails.is_some());
    let name = "front yaw damper 1";
    let (below, above) = (growth(&case, name, 75), growth(&case, name, 95));
    assert!(below < 0.95 && above > 1.05, "{below}, {above}");
}

#[test]
fn motion_grows_above_the_critical_delay_and_decays_below_it() {
    for end in ["front", "rear"] {
        check("coach", 160.0, &format!("{end} vertical damper 1"));
        check("locomotive", 400.0, &format!("{end} yaw damper 1"));
        for number in [1, 2] {
            check(
                "locomotive",
                400.0,
                &format!("{end} lateral damper {number}"),
            );
        }
    }
}
