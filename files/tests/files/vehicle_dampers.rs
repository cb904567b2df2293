//! Dampers of a vehicle file: replacement, overrides, and relative file names.

use std::fs;

use dashpot_core::DamperParameters;
use dashpot_files::damper::{self, PRESETS};
use dashpot_files::vehicle::{self, Replacement};
use dashpot_rail::vehicle::{Direction, Law, VehicleParameters};

/// Name, direction and parameters of each damper.
fn dampers(vehicle: &VehicleParameters) -> Vec<(&str, Direction, &DamperParameters)> {
    let elements = vehicle.elements.iter();
    let dampers = elements.filter_map(|element| match &element.law {
        Law::Damper {
            direction,
            parameters,
        } => Some((element.name.as_str(), *direction, &**parameters)),
        _ => None,
    });
    dampers.collect()
}

fn replacements(texts: &[&str]) -> Vec<Replacement> {
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

#[test]
fn a_name_takes_precedence_over_a_direction() {
    let texts = ["front vertical damper=in-service", "vertical=paper"];
    let vehicle = vehicle::load_with("coach", &replacements(&texts), &[]).unwrap();
    let paper = damper::load("paper", &[]).unwrap();
    let in_service = damper::load("in-service", &[]).unwrap();
    let coach = vehicle::load("coach", &[]).unwrap();
    for (now, before) in dampers(&vehicle).into_iter().zip(dampers(&coach)) {
        let expected = match now {
            (name, ..) if name.starts_with("front vertical damper") => &*in_service,
            (_, Direction::Vertical, _) => &*paper,
            _ => before.2,
        };
        assert_eq!(now.2, expected, "{}", now.0);
    }
}

#[test]
fn overrides_come_after_replacements() {
    let set = "rear lateral damper.set=['mount.clearance_m=2e-3']";
    let replaced = replacements(&["lateral=in-service"]);
    let vehicle = vehicle::load_with("locomotive", &replaced, &[set.into()]).unwrap();
    let expected = damper::load("in-service", &["mount.clearance_m=2e-3".into()]).unwrap();
    let all = dampers(&vehicle);
    let found = all
        .iter()
        .find(|damper| damper.0 == "rear lateral damper 2");
    assert_eq!(found.unwrap().2, &*expected);
}

#[test]
fn an_override_selects_a_direction_a_name_or_one_damper() {
    let [sets @ .., refused] = [
        ("vertical.mount.clearance_m=2e-3", 8),
        ("front vertical damper.mount.clearance_m=2e-3", 4),
        ("rear vertical damper 3.mount.clearance_m=2e-3", 1),
        ("vertical.mount.clearence_m=2e-3", 0),
    ];
    let plain = vehicle::load("locomotive", &[]).unwrap();
    let preset = ["vertical.mount.clearance_m=2e-3".to_owned()];
    let changed = |set: &str| vehicle::load("locomotive", &[set.to_owned()]);
    for (set, count) in sets {
        let now = changed(set).unwrap();
        let now = dampers(&now).into_iter().zip(dampers(&plain));
        let others: Vec<_> = now.filter(|(now, before)| now != before).collect();
        assert_eq!(others.len(), count, "{set}");
        let expected = damper::load("reduced-vertical", &[preset[0][9..].to_owned()]).unwrap();
        assert!(others.iter().all(|(now, _)| *now.2 == *expected), "{set}");
    }
    let message = changed(refused.0).unwrap_err().to_string();
    assert!(message.contains("did you mean `clearance_m`?"), "{message}");
    let message = changed("verticl.mount.clearance_m=1")
        .unwrap_err()
        .to_string();
    assert!(message.contains("did you mean `vertical`?"), "{message}");
}

#[test]
fn unknown_dampers_are_refused() {
    for (text, expected) in [
        (
            "verticl=paper",
            "dampers verticl=paper: no damper `verticl`; did you mean `vertical`?",
        ),
        (
            "longitudinal=paper",
            "dampers longitudinal=paper: no damper `longitudinal`",
        ),
        (
            "vertical=papr",
            "dampers vertical=papr: damper `papr`: no such preset or file",
        ),
    ] {
        let error = vehicle::load_with(
            "locomotive-without-yaw-dampers",
            &replacements(&[text]),
            &[],
        )
        .unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with(expected), "{message}");
    }
    for text in ["vertical", "=paper", "vertical="] {
        let message = text.parse::<Replacement>().unwrap_err();
        assert!(message.contains("allowed: WHICH=DAMPER"), "{message}");
    }
}

#[test]
fn damper_files_are_relative_to_the_vehicle_file() {
    let folder = tempfile::tempdir().unwrap();
    let worn = "[reduced]\ndamping_n_s_per_m = 5e4\nsaturation_velocity_m_per_s = 0.1\n[mount]\nstiffness_n_per_m = \
     3e6\n";
    fs::write(folder.path().join("worn.toml"), worn).unwrap();
    let text = include_str!("../../../data/vehicles/locomotive.toml");
    let text = text.replace("\"reduced-lateral\"", "\"worn.toml\"");
    let path = folder.path().join("own.toml");
    fs::write(&path, &text).unwrap();
    let own = vehicle::load(path.to_str().unwrap(), &[]).unwrap();
    let worn = damper::parse("worn", worn, &[]).unwrap();
    let lateral = dampers(&own)
        .into_iter()
        .filter(|damper| damper.1 == Direction::Lateral);
    let lateral: Vec<&DamperParameters> = lateral.map(|damper| damper.2).collect();
    assert_eq!(lateral, [&*worn; 4]);
}

#[test]
fn a_changed_damper_equals_its_file_with_the_override() {
    for (preset, _) in PRESETS {
        let plain = damper::load(preset, &[]).unwrap();
        assert_eq!(*damper::change(preset, &plain, &[]).unwrap(), *plain);
        let overrides = ["mount.clearance_m=4e-3".to_owned()];
        let changed = damper::change(preset, &plain, &overrides).unwrap();
        assert_eq!(*changed, *damper::load(preset, &overrides).unwrap());
    }
    let paper = damper::load("paper", &[]).unwrap();
    let refused = damper::change("paper", &paper, &["mount.clearence_m=1".into()]);
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("did you mean `clearance_m`?"), "{message}");
}
