//! A vehicle as a part of another simulation: its own dampers' forces given back are its own run; states across a fault; other bytes.

use dashpot_files::case::{Case, CaseOptions};
use dashpot_vehicle_run::{Coupled, CoupledCase, Ending, Run};

const OUTSIDE: &str = "front lateral damper 1";

/// 0.4 s of a shipped vehicle, a damper of it replaced after 0.2 s.
fn case(vehicle: &str, fault: &str) -> Case {
    let text = format!(
        "name = \"a fault\"\nvehicle = \"{vehicle}\"\ntrack = \"straight\"\nspeed_km_h = 160\nduration_s = 0.4\n\
         [[fault]]\ntime_s = 0.2\ndamper = \"{fault}\"\ndamper_file = \"in-service\"\n"
    );
    CaseOptions::parse("fault.toml", &text)
        .unwrap()
        .case()
        .unwrap()
}

fn coupled(of: &CoupledCase) -> Coupled {
    let tables = of.contact().unwrap().tables().unwrap();
    Coupled::new(of, tables).unwrap()
}

fn bits(vehicle: &Coupled) -> Vec<u64> {
    let places = 0..vehicle.variables().len();
    places
        .map(|place| vehicle.number(place).unwrap().to_bits())
        .collect()
}

/// Rows of all numbers after each of the ticks, with a force that changes.
fn rows(vehicle: &mut Coupled, ticks: std::ops::Range<u64>) -> Vec<Vec<u64>> {
    ticks
        .map(|tick| {
            vehicle
                .set_force_n(0, 8e3 * (0.05 * tick as f64).sin())
                .unwrap();
            assert_eq!(vehicle.step(1).unwrap(), 1);
            bits(vehicle)
        })
        .collect()
}

#[test]
fn states_go_on_with_the_same_bits_across_a_fault_and_through_serde() {
    let of = CoupledCase::new(
        &case("locomotive", "rear lateral damper 1"),
        &[OUTSIDE.into()],
    )
    .unwrap();
    let text = serde_json::to_string(&of).unwrap();
    let read: CoupledCase = serde_json::from_str(&text).unwrap();
    assert_eq!(read, of);
    let mut vehicle = coupled(&of);
    let mut other = coupled(&read);
    rows(&mut vehicle, 0..100);
    let before = vehicle.saved().unwrap();
    let expected = rows(&mut vehicle, 100..400);
    let at_end = vehicle.saved().unwrap();
    assert_eq!(vehicle.step(1).unwrap(), 0);
    assert_eq!(
        (vehicle.ending(), vehicle.ending_number()),
        (Some(&Ending::Completed), 1)
    );
    other.restore(&before).unwrap();
    assert_eq!(rows(&mut other, 100..400), expected);
    // Back before the fault, and on from behind it.
    vehicle.restore(&before).unwrap();
    assert_eq!(vehicle.ending(), None);
    let to_250 = rows(&mut vehicle, 100..250);
    let behind = vehicle.saved().unwrap();
    assert_eq!(to_250, expected[..150]);
    vehicle.restore(&at_end).unwrap();
    assert_eq!(bits(&vehicle), expected[299]);
    vehicle.restore(&behind).unwrap();
    assert_eq!(rows(&mut vehicle, 250..400), expected[150..]);
    vehicle.reset();
    assert_eq!(bits(&vehicle), bits(&coupled(&of)));
}

#[test]
fn bytes_of_another_vehicle_or_none_change_nothing() {
    let outside = [OUTSIDE.to_owned()];
    let of = CoupledCase::new(&case("locomotive", "rear lateral damper 1"), &outside).unwrap();
    let mut vehicle = coupled(&of);
    rows(&mut vehicle, 0..10);
    let before = vehicle.saved().unwrap();
    let coach = case("coach", "lateral");
    let name = coach.vehicle.dampers().next().unwrap().name.clone();
    let of_coach = CoupledCase::new(&coach, &[name]).unwrap();
    let others = [
        coupled(&of_coach).saved().unwrap(),
        before[..before.len() / 2].to_vec(),
        Vec::new(),
    ];
    for bytes in others {
        assert!(vehicle.restore(&bytes).is_err());
        assert_eq!(vehicle.saved().unwrap(), before);
    }
}

/// With the force that the damper inside has at the end of each tick, the vehicle is that with all dampers inside, to the bit.
#[test]
fn forces_of_its_own_damper_are_its_own_run() {
    let case = case("locomotive", "rear lateral damper 1");
    let of = CoupledCase::new(&case, &[OUTSIDE.into()]).unwrap();
    let mut vehicle = coupled(&of);
    let mut own = Run::new(&case).unwrap();
    let number = own
        .vehicle()
        .damper_names()
        .position(|name| name == OUTSIDE)
        .unwrap();
    let displacement = format!("{}_displacement_m", OUTSIDE.replace(' ', "_"));
    let place = vehicle
        .variables()
        .iter()
        .position(|variable| variable.name == displacement)
        .unwrap();
    let (mut error, mut most) = (0.0_f64, 0.0_f64);
    for _ in 0..400 {
        own.step().unwrap();
        // As a damper that follows the vehicle without delay would have it.
        vehicle
            .set_force_n(0, own.state().damper_forces_n()[number])
            .unwrap();
        assert_eq!(vehicle.step(1).unwrap(), 1);
        let x = own.state().damper_displacements_m()[number];
        error = error.max((vehicle.number(place).unwrap() - x).abs());
        most = most.max(x.abs());
    }
    assert!(most > 1e-4, "{most}");
    assert_eq!(error, 0.0);
}

#[test]
fn a_vehicle_that_diverges_stays_where_it_was() {
    let case = case("locomotive", "rear lateral damper 1");
    let of = CoupledCase::new(&case, &[OUTSIDE.into()]).unwrap();
    let mut vehicle = coupled(&of);
    rows(&mut vehicle, 0..10);
    let before = bits(&vehicle);
    vehicle.set_force_n(0, 1e300).unwrap();
    assert_eq!(vehicle.step(5).unwrap(), 0);
    assert_eq!(vehicle.ending_number(), 4);
    assert!(
        vehicle
            .ending()
            .unwrap()
            .to_string()
            .starts_with("diverged at 0.01")
    );
    let force = bits(&vehicle)[0];
    assert_eq!(f64::from_bits(force), 1e300);
    assert_eq!(bits(&vehicle)[1..], before[1..]);
    let saved = vehicle.saved().unwrap();
    vehicle.reset();
    assert_eq!(vehicle.ending_number(), 0);
    vehicle.restore(&saved).unwrap();
    assert_eq!(vehicle.ending_number(), 4);
}
