//! `-` is standard input or standard output wherever a command asks for a file.

use std::path::Path;

use assert_cmd::assert::OutputAssertExt;
use predicates::str::contains;

use crate::common::{
    command, dashpot, dashpot_reading, error_of, files_in, json_of, json_on_stderr, text_of,
};

const MOTION: &[u8] = b"time_s,displacement_m\n0,0\n0.001,0.001\n0.002,0.003\n0.003,0.002\n";

/// The shipped file `name`.
fn shipped(name: &str) -> Vec<u8> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../data");
    std::fs::read(data.join(name)).unwrap()
}

#[test]
fn replay_reads_and_writes_streams() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), MOTION).unwrap();
    let by_files = ["replay", "--input", "in.csv", "--output", "out.csv"];
    dashpot(&by_files, folder.path()).success();
    let expected = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();

    let by_streams = [
        "replay", "--input", "-", "--output", "-", "--format", "json",
    ];
    let output = dashpot_reading(MOTION, &by_streams, folder.path()).success();
    assert_eq!(text_of(&output), expected);
    // Standard output is reserved for the data.
    assert_eq!(json_on_stderr(&output)["ticks"], 4);
    assert_eq!(files_in(folder.path()), ["in.csv", "out.csv"]);

    dashpot_reading(MOTION, &by_streams[..5], folder.path())
        .stderr(contains("wrote standard output"));
}

#[test]
fn verify_reads_a_stream_for_all_its_steps() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["verify", "--input", "-", "--format", "json"];
    let output = dashpot_reading(MOTION, &arguments, folder.path()).success();
    let report = json_of(&output);
    assert_eq!(report["deviations"].as_array().unwrap().len(), 6);
}

#[test]
fn every_command_reads_its_damper_from_a_stream() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), MOTION).unwrap();
    let damper = shipped("dampers/paper.toml");
    for arguments in [
        &["replay", "--input", "in.csv", "--output", "out.csv"][..],
        &["verify", "--input", "in.csv", "--step-us", "1000"],
        &["rig"],
        &["shims", "--no-plots"],
        &["budget", "--steps", "100"],
        &["export", "--lang", "bin", "--output", "damper.bin"],
    ] {
        let all = [arguments, &["--damper", "-"]].concat();
        dashpot_reading(&damper, &all, folder.path()).success();
        dashpot_reading(b"[geometry]\nrod = 1\n", &all, folder.path())
            .code(1)
            .stderr(contains("standard input: TOML parse error at line 2"));
    }
}

#[test]
fn export_writes_a_stream() {
    let folder = tempfile::tempdir().unwrap();
    let damper = shipped("dampers/reduced-vertical.toml");
    for lang in ["rust", "c", "bin"] {
        let arguments = ["export", "--damper", "-", "--lang", lang, "--output"];
        let to_file = [&arguments[..], &["file"]].concat();
        dashpot_reading(&damper, &to_file, folder.path()).success();
        let to_stream = [&arguments[..], &["-"]].concat();
        let output = dashpot_reading(&damper, &to_stream, folder.path())
            .success()
            .stderr(contains("standard output: - for a step of 1000 us"));
        let written = std::fs::read(folder.path().join("file")).unwrap();
        if lang == "bin" {
            assert_eq!(output.get_output().stdout, written);
        } else {
            // Everything except the command line in the comment.
            let written = String::from_utf8(written).unwrap();
            assert_eq!(text_of(&output), written.replace("'file'", "'-'"));
            assert!(written.contains(" DAMPER"), "the constant's name");
        }
    }
    assert_eq!(files_in(folder.path()), ["file", "file.h"]);
}

#[test]
fn the_demonstration_writes_its_page_to_a_stream() {
    let folder = tempfile::tempdir().unwrap();
    let output = dashpot(&["--output", "-"], folder.path())
        .success()
        .stderr(contains("page: standard output"));
    let page = text_of(&output);
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    assert!(files_in(folder.path()).is_empty());
}

#[test]
fn contact_reads_a_profile_from_a_stream() {
    let folder = tempfile::tempdir().unwrap();
    let mut rail = String::from("y_mm,z_mm\n");
    for place in -36..=36 {
        let y = f64::from(place);
        rail.push_str(&format!("{y},{}\n", 30.0 * (y / 36.0).powi(4)));
    }
    let arguments = ["contact", "--no-plots", "--rail", "-"];
    let output = dashpot_reading(rail.as_bytes(), &arguments, folder.path()).success();
    assert!(
        text_of(&output).starts_with("S1002 on standard input"),
        "{output:?}"
    );
    dashpot_reading(b"0,0\n1,nan\n", &arguments, folder.path())
        .stderr(contains("standard input:2: column z_mm"));
}

#[test]
fn pil_reads_a_motion_from_a_stream() {
    let folder = tempfile::tempdir().unwrap();
    // The motion is checked before the target is contacted.
    let arguments = ["pil", "--link", "qemu:no-such-image", "--input", "-"];
    dashpot_reading(b"a,b\n0,0\n", &arguments, folder.path())
        .stderr(contains("standard input: column time_s is missing"));
    dashpot_reading(MOTION, &arguments, folder.path())
        .stderr(contains("no-such-image: no firmware image there"));
}

#[test]
fn one_stream_serves_one_option() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, options) in [
        (
            &["replay", "--damper", "-", "--input", "-", "--output", "-"][..],
            "--damper and --input",
        ),
        (
            &["verify", "--damper", "-", "--input", "-"],
            "--damper and --input",
        ),
        (
            &["pil", "--link", "qemu", "--damper", "-", "--input", "-"],
            "--damper and --input",
        ),
        (
            &["contact", "--wheel", "-", "--rail", "-"],
            "--wheel and --rail",
        ),
    ] {
        let output = dashpot_reading(b"", arguments, folder.path()).code(2);
        let error = error_of(&output);
        assert!(error.contains(options), "{arguments:?}: {error}");
    }
    assert!(files_in(folder.path()).is_empty());
}

#[test]
fn a_file_called_minus_is_named_with_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("-"), MOTION).unwrap();
    let arguments = ["replay", "--input", "./-", "--output", "out.csv"];
    dashpot_reading(b"", &arguments, folder.path()).success();
}

/// A reader that closes the pipe, such as `head`, is not an error and needs no message.
#[test]
fn data_whose_reader_has_left_is_no_failure() {
    let ride = "data/excitations/ride_made.csv";
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for arguments in [
        &["replay", "--input", ride, "--output", "-"][..],
        &["export", "--lang", "c", "--output", "-"],
        &["export", "--lang", "c", "--standalone", "--output", "-"],
        &[
            "export", "--lang", "bin", "--output", "-", "--format", "json",
        ],
        &["--output", "-"],
        &["shims", "--no-plots"],
        &["shims", "--no-plots", "--format", "json"],
        &["contact", "--no-plots"],
        &["contact", "--no-plots", "--format", "json"],
        &["rig"],
        &["budget", "--steps", "1000"],
    ] {
        // The reader is gone before the command starts, so nothing can be written.
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = command(arguments, &root);
        command.stdout(writer).assert().success().stderr("");
    }
}
