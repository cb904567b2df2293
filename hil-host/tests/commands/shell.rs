//! Completions, manual pages, help and version of the command.

use crate::common::{dashpot, error_of, text_of};

#[test]
fn completions_know_commands_and_options() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let text = text_of(&dashpot(&["completions", shell], folder.path()).success());
        for word in ["calibrate", "benchmark", "speed-km-h"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    dashpot(&["man", "--output", "."], folder.path()).success();
    let page = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(page("dashpot.1").contains("dashpot\\-vehicle(1)"));
    assert!(page("dashpot-hybrid-plan.1").contains("margin"));
    let missing = dashpot(&["man", "--output", "missing"], folder.path()).code(1);
    assert!(error_of(&missing).contains("missing: no such folder"));
}

#[test]
fn the_help_lists_commands_in_groups() {
    let folder = tempfile::tempdir().unwrap();
    let help = text_of(&dashpot(&["--help"], folder.path()).success());
    let vehicles = help.split("Vehicles:\n").nth(1).unwrap();
    assert!(vehicles.starts_with("  vehicle"), "{help}");
    assert!(
        help.lines().all(|line| line.chars().count() <= 120),
        "{help}"
    );
}

#[test]
fn the_long_version_tells_commit_and_features() {
    let folder = tempfile::tempdir().unwrap();
    let version = text_of(&dashpot(&["--version"], folder.path()).success());
    let lines: Vec<&str> = version.lines().collect();
    assert_eq!(lines[0], concat!("dashpot ", env!("CARGO_PKG_VERSION")));
    assert!(lines[1].starts_with("commit: "), "{version}");
    assert!(lines[2].starts_with("features: "), "{version}");
    assert_eq!(text_of(&dashpot(&["-V"], folder.path())).lines().count(), 1);
}
