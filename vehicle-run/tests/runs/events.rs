//! Events of a case, compared with closed forms and with runs that have the new values from the start.

use dashpot_files::case::{Case, CaseOptions};
use dashpot_vehicle_run::{CoupledCase, Run};

use crate::coupled::coupled;

/// A coach at 120 km/h on rigid rails, with further lines of its case.
fn case(track: &str, lines: &str) -> Case {
    let text = format!(
        "name = \"events\"\nvehicle = \"coach\"\ntrack = \"{track}\"\nspeed_km_h = 120\nrails = \"rigid\"\n{lines}\n"
    );
    let options = CaseOptions::parse("events.toml", &text).unwrap();
    options.case().unwrap()
}

fn after(case: &Case) -> Run {
    let mut run = Run::new(case).unwrap();
    while !run.is_over() {
        assert_eq!(run.step().unwrap(), None);
    }
    run
}

/// A side wind of 20 kN at the height `h` above the rails and 20 kN that pull the body down: the rails carry both, and
/// the loads on the lee side exceed those on the other by `2 F h/b`, with the distance `b` of the contact points, which
/// is about 1.5 m and grows by less than a percent with the shift.
#[test]
fn the_rails_carry_an_applied_force_and_its_moment() {
    let still = after(&case("ideal", "duration_s = 8"));
    let pressed = after(&case(
        "ideal",
        "duration_s = 8\n[[event]]\ntime_s = 1\nramp_s = 2\nforce_on = \"body\"\nforce_at_m = [0, 0, 2.0]\n\
         force_n = [20e3, 20e3]",
    ));
    let sums = |run: &Run| {
        let contacts = run.state().contacts().iter();
        let mut sums = [0.0; 3];
        for contact in contacts {
            sums[0] += contact.force_n[1];
            sums[1] += contact.force_n[2];
            let of_side = |side: usize| {
                let patches = contact.wheels[side].loaded_patches();
                patches.map(|patch| patch.load_n).sum::<f64>()
            };
            sums[2] += of_side(1) - of_side(0);
        }
        sums
    };
    let [before, with] = [sums(&still), sums(&pressed)];
    assert!((with[0] - before[0] + 20e3).abs() < 200.0, "{with:?}");
    assert!((with[1] - before[1] + 20e3).abs() < 200.0, "{with:?}");
    let expected = 2.0 * 20e3 * 2.0 / 1.5;
    // The body leans over, which moves its weight to the side too.
    let lean_m = pressed.state().coordinates()[0][0];
    let leaning = 2.0 * lean_m * 32e3 * 9.81 / 1.5;
    let moved = with[2] - before[2];
    assert!(
        (moved - expected - leaning).abs() < 0.06 * expected,
        "{moved} for {expected} and {leaning}"
    );
}

/// Braking by 0.5 m/s^2 from 33.3 to 27.8 m/s takes 11.1 s and 339.5 m; in the curve after it, the body stands as if
/// the vehicle had always had the lower speed.
#[test]
fn a_braked_vehicle_stands_in_the_curve_as_a_slower_one() {
    let braking =
        "duration_s = 25\n[[event]]\ntime_s = 2\nramp_s = 11.111111111111111\nspeed_km_h = 100";
    let braked = case("curve-r600", braking);
    let (high, low) = (120.0 / 3.6, 100.0 / 3.6);
    let expected_m = 2.0 * high + 0.5 * (high + low) * (100.0 / 9.0) + low * (23.0 - 100.0 / 9.0);
    let expected_m = braked.start_m + expected_m;
    assert!((braked.end_m() - expected_m).abs() < 1e-9);
    let run = after(&braked);
    assert!((run.state().distance_m() - expected_m).abs() < 1e-6);
    assert_eq!(run.state().speed_m_per_s(), low);
    let mut slow = case("curve-r600", "duration_s = 25");
    slow.speed_m_per_s = low;
    let slow = after(&slow);
    for (a, b) in run
        .state()
        .coordinates()
        .iter()
        .zip(slow.state().coordinates())
    {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 5e-5, "{a} {b}");
        }
    }
}

#[test]
fn half_the_friction_from_the_start_is_half_the_friction_coefficient() {
    let halved = "duration_s = 2\nfriction = 0.4\n[[event]]\ntime_s = 0\nfriction_factor = 0.5";
    let [halved, low] =
        [halved, "duration_s = 2\nfriction = 0.2"].map(|lines| after(&case("curve-r600", lines)));
    for (a, b) in halved.state().contacts().iter().zip(low.state().contacts()) {
        for (a, b) in a.force_n.iter().zip(b.force_n) {
            assert!((a - b).abs() < 1e-3 * b.abs().max(100.0), "{a} {b}");
        }
    }
}

/// A restored state goes on with the same bits, before, in and after a ramp; the time alone decides what an event does.
#[test]
fn restored_states_continue_with_the_same_bits_across_events() {
    let case = case(
        "straight",
        "duration_s = 0.6\n[[event]]\ntime_s = 0.2\nramp_s = 0.2\nfriction_factor = 0.3\n[[event]]\ntime_s = 0.1\n\
         ramp_s = 0.4\nspeed_km_h = 118\n[[event]]\ntime_s = 0.3\nforce_on = \"body\"\nforce_at_m = [1, 0, 2]\n\
         force_n = [9e3, 0]",
    );
    let definition = CoupledCase::new(&case, &[]).unwrap();
    let mut vehicle = coupled(&definition);
    let mut saved = Vec::new();
    for _ in 0..6 {
        saved.push(vehicle.save().unwrap());
        assert_eq!(vehicle.step(100).unwrap(), 100);
    }
    let end = vehicle.save().unwrap();
    for (index, state) in saved.iter().enumerate() {
        vehicle.restore(state).unwrap();
        vehicle.step(600 - 100 * index as u64).unwrap();
        assert_eq!(vehicle.save().unwrap(), end, "from {index}00 ms");
    }
}
