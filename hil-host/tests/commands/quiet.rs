//! `--quiet` leaves out reports, and verdicts have colours only where the terminal shows them.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::common::{command, dashpot, error_of, files_in, json_of, text_of};

const VEHICLE: [&str; 6] = [
    "vehicle",
    "--case",
    "straight-180",
    "--duration-s",
    "0.1",
    "--no-page",
];

#[test]
fn a_quiet_command_writes_its_files_and_prints_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let loud = dashpot(&VEHICLE, folder.path()).success();
    assert!(error_of(&loud).contains("note: the run takes 0.1 s"));
    assert!(text_of(&loud).contains("wrote "), "{}", text_of(&loud));
    fs::remove_dir_all(folder.path().join("dashpot-vehicle")).unwrap();
    let before = [&["-q"][..], &VEHICLE].concat();
    for quiet in [&[&VEHICLE[..], &["--quiet"]].concat(), &before] {
        let ended = dashpot(quiet, folder.path()).success();
        assert_eq!(
            (text_of(&ended), error_of(&ended)),
            (String::new(), String::new())
        );
        assert!(!files_in(&folder.path().join("dashpot-vehicle")).is_empty());
    }
    let json = [&VEHICLE[..], &["--quiet", "--format", "json"]].concat();
    let report = json_of(&dashpot(&json, folder.path()).success());
    assert!(report["ticks"].as_u64() > Some(0), "{report}");
}

#[test]
fn a_quiet_command_prints_what_was_asked_for_and_errors() {
    let folder = tempfile::tempdir().unwrap();
    for list in [
        &["dampers"][..],
        &["show", "damper", "paper"],
        &["sweep", "paper", "--seeds", "1", "--list"],
    ] {
        let loud = dashpot(list, folder.path()).success();
        let quiet = dashpot(&[list, &["--quiet"]].concat(), folder.path()).success();
        let first = |text: String| text.lines().next().unwrap().to_owned();
        assert_eq!(first(text_of(&quiet)), first(text_of(&loud)), "{list:?}");
    }
    let error = error_of(&dashpot(&["show", "damper", "papr", "-q"], folder.path()).code(2));
    assert!(error.starts_with("error: "), "{error}");
}

const SHEET: [&str; 5] = ["rig", "--damper", "in-service", "--sheet", "example"];

/// Runs the command with a variable that controls colours.
fn with(variable: &str, arguments: &[&str], folder: &Path) -> Output {
    let mut command = command(arguments, folder);
    for variable in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(variable);
    }
    command.env(variable, "1").output().unwrap()
}

#[test]
fn verdicts_have_colours_if_forced_and_are_plain_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let plain = with("NO_COLOR", &SHEET, folder.path());
    assert_eq!(with("CLICOLOR", &SHEET, folder.path()).stdout, plain.stdout);
    let coloured = with("CLICOLOR_FORCE", &SHEET, folder.path()).stdout;
    let coloured = String::from_utf8(coloured).unwrap();
    assert!(coloured.contains("\x1b[32mwithin   \x1b[0m"), "{coloured}");
    let stripped = ["\x1b[32m", "\x1b[31m", "\x1b[33m", "\x1b[0m"]
        .iter()
        .fold(coloured, |text, code| text.replace(code, ""));
    assert_eq!(stripped, String::from_utf8(plain.stdout).unwrap());
    let json = [&SHEET[..], &["--format", "json"]].concat();
    let json = with("CLICOLOR_FORCE", &json, folder.path()).stdout;
    assert!(!json.contains(&b'\x1b'));
}

#[test]
fn errors_and_warnings_have_colours_too() {
    let folder = tempfile::tempdir().unwrap();
    let unknown = ["show", "damper", "papr"];
    let error = with("CLICOLOR_FORCE", &unknown, folder.path()).stderr;
    assert!(error.starts_with(b"\x1b[31merror:\x1b[0m "));
    let note = with("CLICOLOR_FORCE", &VEHICLE, folder.path()).stderr;
    assert!(note.starts_with(b"\x1b[33mnote:\x1b[0m the run takes"));
}
