//! Wear of the wheels over a run, and runs on worn profiles.

use std::sync::Arc;

use dashpot_files::case::{Case, CaseOptions};
use dashpot_rail::contact::{ContactGeometry, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::profile::{Profile, s1002, uic60};
use dashpot_vehicle_run::signals::lateral_n;
use dashpot_vehicle_run::wear::WearLaw;
use dashpot_vehicle_run::{Ending, Indexer, Run, RunWear};
use dashpot_wear::procedure::{Collective, Procedure, WornPair};

fn curve(duration_s: f64) -> Case {
    let mut options = CaseOptions::load("curve-r300").unwrap();
    options.duration_s = duration_s;
    options.case().unwrap()
}

#[test]
fn the_wear_of_a_run_agrees_with_its_wear_numbers() {
    let case = curve(6.0);
    for law in [WearLaw::default(), WearLaw::t_gamma()] {
        let mut run = Run::new(&case).unwrap();
        let mut indexer = Indexer::new(&case);
        let mut wear = RunWear::new(&case, &run, law);
        assert!(wear.indices().is_none());
        while run.step().unwrap().is_none() {
            indexer.add(run.state());
            wear.add(run.state());
        }
        let indices = indexer.indices().unwrap();
        let wear = wear.indices().unwrap();
        assert_eq!((wear.law, wear.wheels.len()), (law.name(), 12));
        assert!(wear.note.starts_with("Estimate"));
        assert!((wear.distance_m - 6.0 * case.speed_m_per_s).abs() < 1e-6);
        for (wheelset, wheels) in indices.wheelsets.iter().zip(wear.wheels.chunks(2)) {
            let sum_n = wheels[0].wear_number_n + wheels[1].wear_number_n;
            // The law takes the speed with the bound near standstill; their squares differ by 0.05^2.
            assert!((sum_n / wheelset.wear_number_n - 1.0).abs() < 1e-4);
            for wheel in wheels {
                assert!(wheel.max_depth_m > 0.0 && wheel.wheelset == wheelset.wheelset);
                let per_1000km = 1e6 * wheel.max_depth_m * 1e6 / wear.distance_m;
                assert!((wheel.max_depth_um_per_1000km / per_1000km - 1.0).abs() < 1e-12);
                assert_eq!(wheel.max_depth_m, wheel.profile.max_depth_m);
            }
        }
        // A right-hand curve: the left wheel of the leading wheelset wears most, at its flange.
        let worst = wear.worst().unwrap();
        assert_eq!((&worst.wheelset[..], worst.side), ("wheelset 1", "left"));
        assert!(worst.max_depth_at_m < -0.02, "{}", worst.max_depth_at_m);
    }
}

/// Archard's law needs the normal load times the sliding distance: the friction work divided by the friction
/// coefficient of the rail, not by that of the case.
#[test]
fn wear_follows_the_friction_of_each_rail() {
    let wear_at = |friction: f64, overrides: &[&str]| {
        let mut options = CaseOptions::load("curve-r300").unwrap();
        options.duration_s = 2.0;
        options.friction = friction;
        options
            .overrides
            .extend(overrides.iter().map(ToString::to_string));
        let case = options.case().unwrap();
        let mut run = Run::new(&case).unwrap();
        let mut wear = RunWear::new(&case, &run, WearLaw::default());
        while run.step().unwrap().is_none() {
            wear.add(run.state());
        }
        let wheels = wear.indices().unwrap().wheels;
        wheels
            .into_iter()
            .map(|wheel| wheel.lost_area_mm2_per_1000km)
    };
    let whole = wear_at(0.2, &[]);
    let by_rail = wear_at(
        0.4,
        &["contact.left_friction=0.2", "contact.right_friction=0.2"],
    );
    for (whole, by_rail) in whole.zip(by_rail) {
        assert!((by_rail / whole - 1.0).abs() < 1e-3, "{whole} {by_rail}");
    }
}

/// The profile with its tread datum at depth 0, as a profile gauge reports it. A wheelset that stands level needs
/// wheels of equal height.
fn at_datum(wheel: &Profile) -> Profile {
    let datum_m = wheel.at(0.0).z_m;
    let points_m: Vec<[f64; 2]> = wheel
        .points()
        .iter()
        .map(|point| [point.y_m, point.z_m - datum_m])
        .collect();
    Profile::through(wheel.name(), &points_m, 0.0).unwrap()
}

#[test]
fn unequal_worn_profiles_run_through_a_curve_without_a_jump() {
    let case = curve(6.0);
    let radius_m = case.vehicle.wheelsets[0].radius_m;
    let mut procedure = Procedure::default();
    procedure.installation = procedure.installation.with_wheel_radius_m(radius_m);
    let new = WornPair::new(s1002::profile(), uic60::profile());
    let sides = [Collective::conforming(), Collective::straight()].map(|collective| {
        let worn = procedure.wear(&new, &collective, 0.4e-3).unwrap();
        let pair = Pair::new(at_datum(&worn.wheel), &worn.rail, procedure.installation).unwrap();
        Arc::new(Tables::new(
            ContactGeometry::new(pair, Steel::default()).unwrap(),
        ))
    });
    let friction = Friction::constant(case.friction);
    let contact = WheelsetContact::with_sides(sides, KalkerBook::new(), friction).unwrap();
    let contact = contact
        .with_normal_damping(case.normal_damping_s_per_m)
        .unwrap();
    let track = Arc::new(case.track.build().unwrap());
    let contact = Arc::new(contact);
    let contacts: Vec<_> = case
        .vehicle
        .wheelsets
        .iter()
        .map(|_| contact.clone())
        .collect();
    let mut run = Run::on(&case, contacts, track).unwrap();
    let bodies = run.vehicle().names().len() - run.vehicle().wheelsets();
    let mut before: Option<Vec<[f64; 4]>> = None;
    let mut greatest_n = 0.0_f64;
    let ending = loop {
        if let Some(ending) = run.step().unwrap() {
            break ending;
        }
        let wheelsets = run.state().contacts().iter();
        let coordinates = run.state().coordinates()[bodies..].iter();
        let now: Vec<[f64; 4]> = wheelsets
            .zip(coordinates)
            .map(|(forces, q)| [lateral_n(forces, 0), lateral_n(forces, 1), q[0], q[2]])
            .collect();
        for (now, before) in now.iter().zip(before.iter().flatten()) {
            let moved_m = (now[2] - before[2]).abs() + 0.6 * (now[3] - before[3]).abs();
            for side in 0..2 {
                // 4 kN per micrometre, and what the irregularity of the rails adds in a tick.
                let change_n = (now[side] - before[side]).abs();
                assert!(
                    change_n < 4e9 * moved_m + 10e3,
                    "{change_n} N over {moved_m} m"
                );
                greatest_n = greatest_n.max(change_n);
            }
        }
        before = Some(now);
    };
    assert_eq!(ending, Ending::Completed);
    // The flange is in contact: forces do change.
    assert!((100.0..20e3).contains(&greatest_n), "{greatest_n}");
}
