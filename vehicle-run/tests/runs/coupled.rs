//! A vehicle as part of another simulation: with the forces of its own damper it reproduces its own run; saved states
//! across a fault; invalid bytes.

use dashpot_files::case::{Case, CaseOptions};
use dashpot_vehicle_run::{Coupled, CoupledCase, Ending, Run};

const OUTSIDE: &str = "front lateral damper 1";

/// 0.4 s of a shipped vehicle, with one damper replaced after 0.2 s.
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

/// Builds a coupled vehicle with cached tables.
pub fn coupled(definition: &CoupledCase) -> Coupled {
    let tables = definition.contact().unwrap().tables().unwrap();
    Coupled::new(definition, &tables).unwrap()
}

fn bits(vehicle: &Coupled) -> Vec<u64> {
    let indices = 0..vehicle.variables().len();
    indices
        .map(|index| vehicle.value(index).unwrap().to_bits())
        .collect()
}

/// Bits of all variables after each tick, with a force that changes.
fn rows(vehicle: &mut Coupled, ticks: std::ops::Range<u64>) -> Vec<Vec<u64>> {
    ticks
        .map(|tick| {
            vehicle.set(0, 8e3 * (0.05 * tick as f64).sin()).unwrap();
            assert_eq!(vehicle.step(1).unwrap(), 1);
            bits(vehicle)
        })
        .collect()
}

#[test]
fn restored_states_continue_with_the_same_bits_across_a_fault() {
    let definition = CoupledCase::new(
        &case("locomotive", "rear lateral damper 1"),
        &[OUTSIDE.into()],
    )
    .unwrap();
    let text = serde_json::to_string(&definition).unwrap();
    let read: CoupledCase = serde_json::from_str(&text).unwrap();
    assert_eq!(read, definition);
    let mut vehicle = coupled(&definition);
    let mut other = coupled(&read);
    rows(&mut vehicle, 0..100);
    let before = vehicle.save().unwrap();
    let expected = rows(&mut vehicle, 100..400);
    let at_end = vehicle.save().unwrap();
    assert_eq!(vehicle.step(1).unwrap(), 0);
    assert_eq!(
        (vehicle.ending(), vehicle.ending_code()),
        (Some(&Ending::Completed), 1)
    );
    other.restore(&before).unwrap();
    assert_eq!(rows(&mut other, 100..400), expected);
    // Restore a state before the fault, then states after it.
    vehicle.restore(&before).unwrap();
    assert_eq!(vehicle.ending(), None);
    let to_250 = rows(&mut vehicle, 100..250);
    let behind = vehicle.save().unwrap();
    assert_eq!(to_250, expected[..150]);
    vehicle.restore(&at_end).unwrap();
    assert_eq!(bits(&vehicle), expected[299]);
    vehicle.restore(&behind).unwrap();
    assert_eq!(rows(&mut vehicle, 250..400), expected[150..]);
    vehicle.reset();
    assert_eq!(bits(&vehicle), bits(&coupled(&definition)));
}

#[test]
fn invalid_bytes_change_nothing() {
    let outside = [OUTSIDE.to_owned()];
    let definition =
        CoupledCase::new(&case("locomotive", "rear lateral damper 1"), &outside).unwrap();
    let mut vehicle = coupled(&definition);
    rows(&mut vehicle, 0..10);
    let before = vehicle.save().unwrap();
    let coach = case("coach", "lateral");
    let name = coach.vehicle.dampers().next().unwrap().name.clone();
    let coach_definition = CoupledCase::new(&coach, &[name]).unwrap();
    let others = [
        coupled(&coach_definition).save().unwrap(),
        before[..before.len() / 2].to_vec(),
        Vec::new(),
    ];
    for bytes in others {
        assert!(vehicle.restore(&bytes).is_err());
        assert_eq!(vehicle.save().unwrap(), before);
    }
}

/// The external damper gets the force that the same damper has at the end of each tick of a run without external
/// dampers. Both runs then have the same displacements, bit for bit.
#[test]
fn forces_of_its_own_damper_reproduce_its_own_run() {
    let case = case("locomotive", "rear lateral damper 1");
    let definition = CoupledCase::new(&case, &[OUTSIDE.into()]).unwrap();
    let mut vehicle = coupled(&definition);
    let mut own = Run::new(&case).unwrap();
    let number = own
        .vehicle()
        .damper_names()
        .position(|name| name == OUTSIDE)
        .unwrap();
    let displacement = format!("{}_displacement_m", OUTSIDE.replace(' ', "_"));
    let index = vehicle
        .variables()
        .iter()
        .position(|variable| variable.name == displacement)
        .unwrap();
    let (mut error, mut max) = (0.0_f64, 0.0_f64);
    for _ in 0..400 {
        own.step().unwrap();
        // The force of a damper that follows the vehicle without delay.
        vehicle
            .set(0, own.state().damper_forces_n()[number])
            .unwrap();
        assert_eq!(vehicle.step(1).unwrap(), 1);
        let x = own.state().damper_displacements_m()[number];
        error = error.max((vehicle.value(index).unwrap() - x).abs());
        max = max.max(x.abs());
    }
    assert!(max > 1e-4, "{max}");
    assert_eq!(error, 0.0);
}

#[test]
fn a_vehicle_that_diverges_stays_where_it_was() {
    let case = case("locomotive", "rear lateral damper 1");
    let definition = CoupledCase::new(&case, &[OUTSIDE.into()]).unwrap();
    let mut vehicle = coupled(&definition);
    rows(&mut vehicle, 0..10);
    let before = bits(&vehicle);
    vehicle.set(0, 1e300).unwrap();
    assert_eq!(vehicle.step(5).unwrap(), 0);
    assert_eq!(vehicle.ending_code(), 4);
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
    let saved = vehicle.save().unwrap();
    vehicle.reset();
    assert_eq!(vehicle.ending_code(), 0);
    vehicle.restore(&saved).unwrap();
    assert_eq!(vehicle.ending_code(), 4);
}
