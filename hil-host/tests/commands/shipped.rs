//! Lists of the files that ship, and their texts.

use crate::common::{dashpot, error_of, json_of, text_of};

const LISTS: [(&str, &str, &str); 7] = [
    ("dampers", "damper", "in-service"),
    ("vehicles", "vehicle", "locomotive"),
    ("tracks", "track", "curve-r600"),
    ("cases", "case", "straight-180"),
    ("studies", "study", "out-of-service"),
    ("actuators", "actuator", "servo"),
    ("sheets", "sheet", "example"),
];

#[test]
fn every_list_names_files_that_can_be_shown() {
    let folder = tempfile::tempdir().unwrap();
    for (list, kind, known) in LISTS {
        let report = json_of(&dashpot(&[list, "--format", "json"], folder.path()));
        let files = report["files"].as_array().unwrap();
        assert!(files.iter().any(|file| file["name"] == known), "{list}");
        let text = text_of(&dashpot(&[list], folder.path()));
        for file in files {
            let name = file["name"].as_str().unwrap();
            assert!(
                text.lines().any(|line| line.starts_with(name)),
                "{list} {name}"
            );
            let shown = text_of(&dashpot(&["show", kind, name], folder.path()));
            let copied = folder.path().join("copied.toml");
            assert!(shown.starts_with('#'), "{name}");
            std::fs::write(copied, shown).unwrap();
        }
    }
}

/// The copy of a shipped file is a file that commands accept.
#[test]
fn a_copy_of_a_shipped_damper_can_be_used() {
    let folder = tempfile::tempdir().unwrap();
    let shown = text_of(&dashpot(&["show", "damper", "in-service"], folder.path()));
    std::fs::write(folder.path().join("mine.toml"), shown).unwrap();
    let rig = |damper: &str| {
        let motion = [
            "--amplitude-m",
            "0.01",
            "--frequency-hz",
            "1",
            "--format",
            "json",
        ];
        let report = dashpot(
            &[&["rig", "--damper", damper], &motion[..]].concat(),
            folder.path(),
        );
        json_of(&report)["indices"].clone()
    };
    assert_eq!(rig("mine.toml"), rig("in-service"));
}

#[test]
fn an_unknown_name_is_refused_with_those_that_ship() {
    let folder = tempfile::tempdir().unwrap();
    let error = error_of(&dashpot(&["show", "vehicle", "locomotiv"], folder.path()).code(2));
    assert!(
        error.contains("`locomotiv` does not ship; allowed: locomotive, coach"),
        "{error}"
    );
    assert!(error.contains("did you mean `locomotive`?"), "{error}");
}
