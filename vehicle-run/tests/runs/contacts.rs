//! The contact of each wheelset of a case, its tables, and runs with unequal wheels and rails.

use std::fs;
use std::sync::Arc;

use dashpot_files::case::{Case, CaseOptions};
use dashpot_rail::indices::nadal_limit;
use dashpot_rail::profile::s1002;
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{Coupled, CoupledCase, Ending, Indexer, Run, VehicleRunError};

const CASE: &str = "name = \"ride\"
vehicle = \"coach\"
track = \"ideal\"
speed_km_h = 60
duration_s = 0.3
";

fn case(text: &str) -> Case {
    let options = CaseOptions::parse("case.toml", &format!("{CASE}{text}")).unwrap();
    options.case().unwrap()
}

/// S1002 with a flange cut back by up to 0.5 mm, as a file of columns.
fn worn(folder: &tempfile::TempDir) -> String {
    let mut text = "y_mm,z_mm\n".to_owned();
    for point in s1002::profile().points().iter().step_by(5) {
        let (y, z) = (1e3 * point.y_m, 1e3 * point.z_m);
        let cut = 0.5 * (-((y + 38.0) / 6.0).powi(2)).exp();
        text += &format!("{:.4},{z:.4}\n", y - cut);
    }
    let path = folder.path().join("worn.csv");
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn equal_wheelsets_share_their_contact_and_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    let standard = ContactSetup::of_case(&case("")).unwrap();
    assert_eq!(standard.pairs().len(), 1);
    let contacts = standard.exact().unwrap();
    assert_eq!(contacts.len(), 4);
    assert!(
        contacts
            .iter()
            .all(|contact| Arc::ptr_eq(contact, &contacts[0]))
    );
    let [left, right] = contacts[0].sources();
    assert!(Arc::ptr_eq(left, right));
    // One other wheel: a second pair, and a second contact on its wheelset.
    let worn = worn(&folder);
    let one = case(&format!(
        "[contact]\n[[contact.other_wheel]]\nwheelset = \"wheelset 3\"\nside = \"right\"\nwheel = {worn:?}\n"
    ));
    let setup = ContactSetup::of_case(&one).unwrap();
    assert_eq!(setup.pairs().len(), 2);
    let contacts = setup.exact().unwrap();
    let same: Vec<bool> = contacts
        .iter()
        .map(|contact| Arc::ptr_eq(contact, &contacts[0]))
        .collect();
    assert_eq!(same, [true, true, false, true]);
    let [left, right] = contacts[2].sources();
    assert_eq!(left.pair().wheel().name(), "S1002");
    assert_eq!(right.pair().wheel().name(), "worn");
    // Friction and damping do not need other tables.
    let mut slippery = case("[contact]\nright_friction = 0.1\nresidual_friction_ratio = 0.5\n");
    slippery.normal_damping_s_per_m = 1.0;
    assert_eq!(
        ContactSetup::of_case(&slippery).unwrap().pairs(),
        standard.pairs()
    );
    let geometry = Arc::new(setup.pairs()[0].geometry().unwrap());
    let error = setup.contacts(&[geometry]).unwrap_err();
    assert!(
        matches!(
            error,
            VehicleRunError::Sources {
                sources: 1,
                pairs: 2
            }
        ),
        "{error}"
    );
}

#[test]
fn every_wheelset_has_its_own_radius() {
    let mut unequal = case("");
    unequal.vehicle.wheelsets[1].radius_m = 0.40;
    let setup = ContactSetup::of_case(&unequal).unwrap();
    let radii = setup.exact().unwrap();
    let radii = radii
        .iter()
        .map(|contact| contact.sources()[1].pair().installation().wheel_radius_m);
    let expected = unequal
        .vehicle
        .wheelsets
        .iter()
        .map(|wheelset| wheelset.radius_m);
    assert_eq!(radii.collect::<Vec<_>>(), expected.collect::<Vec<_>>());
    assert_eq!(setup.pairs().len(), 2);
}

/// The limit of each wheel follows from its own flange and the largest friction of its rail.
#[test]
fn nadals_limit_is_that_of_each_wheel() {
    let folder = tempfile::tempdir().unwrap();
    let worn = worn(&folder);
    let case = case(&format!(
        "[contact]\nright_friction = 0.5\n[[contact.other_wheel]]\nwheelset = \"wheelset 3\"\nside = \"left\"\n\
         wheel = {worn:?}\n"
    ));
    let run = Run::new(&case).unwrap();
    let mut indexer = Indexer::new(&case);
    indexer.add(run.state());
    let indices = indexer.indices().unwrap();
    let limits = &indices.nadal_limits;
    assert_eq!(limits.len(), 3);
    let wheels = |limit: usize| {
        let wheels = limits[limit].wheels.iter();
        wheels
            .map(|wheel| format!("{} {}", wheel.wheelset, wheel.side))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        wheels(0),
        ["wheelset 1 left", "wheelset 2 left", "wheelset 4 left"]
    );
    assert_eq!(wheels(1).len(), 4);
    assert_eq!(wheels(2), ["wheelset 3 left"]);
    assert_eq!(
        [limits[0].friction, limits[1].friction, limits[2].friction],
        [0.4, 0.5, 0.4]
    );
    assert_eq!(limits[2].profile, "worn");
    assert!((limits[0].flange_angle_rad.to_degrees() - 70.0).abs() < 0.1);
    assert!(
        (limits[2].flange_angle_rad - limits[0].flange_angle_rad).abs() > 1e-3,
        "{limits:?}"
    );
    for limit in limits {
        assert_eq!(
            limit.limit,
            nadal_limit(limit.flange_angle_rad, limit.friction)
        );
    }
    assert_eq!(indices.nadal, limits[1]);
}

/// The definition of a coupled vehicle carries profiles, friction and gauge, and names no file.
#[test]
fn a_coupled_case_needs_no_profile_file() {
    let folder = tempfile::tempdir().unwrap();
    let worn = worn(&folder);
    let case = case(&format!(
        "[contact]\nfriction_over_distance = [[0, 0.4, 0.4], [3, 0.4, 0.2]]\n\
         gauge_over_distance = [[0, 1.435], [4, 1.438]]\n\
         [[contact.other_wheel]]\nwheelset = \"wheelset 1\"\nside = \"left\"\nwheel = {worn:?}\n"
    ));
    let mut run = Run::new(&case).unwrap();
    let ending = loop {
        if let Some(ending) = run.step().unwrap() {
            break ending;
        }
    };
    assert_eq!(ending, Ending::Completed);
    let definition = CoupledCase::new(&case, &["front lateral damper 1".to_owned()]).unwrap();
    let json = serde_json::to_string(&definition).unwrap();
    drop(folder);
    assert!(!json.contains("worn.csv") && !json.contains(&*std::env::temp_dir().to_string_lossy()));
    let read: CoupledCase = serde_json::from_str(&json).unwrap();
    assert_eq!(read, definition);
    let contact = read.contact().unwrap();
    let written = definition.contact().unwrap();
    let mut tables = Vec::new();
    for (pair, original) in contact.pairs().iter().zip(written.pairs()) {
        let bytes = original.tables().unwrap().to_bytes();
        assert_eq!(
            pair.tables_file_name().unwrap(),
            original.tables_file_name().unwrap()
        );
        tables.push(pair.tables_from(&bytes).unwrap());
    }
    assert_eq!(tables.len(), 2);
    let mut coupled = Coupled::new(&read, &tables).unwrap();
    assert_eq!(coupled.step(300).unwrap(), 300);
    assert_eq!(coupled.ending(), None);
    let error = Coupled::new(&read, &tables[..1]).unwrap_err();
    assert!(matches!(error, VehicleRunError::Sources { .. }), "{error}");
}
