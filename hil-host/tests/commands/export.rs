//! `dashpot export` as a command; the exported file is compiled and run.

use std::path::Path;
use std::process::Command;

use assert_cmd::assert::OutputAssertExt;
use dashpot_testbench::excitation::Excitation;

use crate::common::{dashpot, text_of};

#[test]
fn the_exported_damper_steps_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["export", "--damper", "in-service", "--lang", "rust"];
    let files = ["--output", "damper.rs"];
    dashpot(&[&arguments[..], &files].concat(), folder.path()).success();
    let manifest = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let core = manifest.parent().unwrap().join("core");
    std::fs::write(
        folder.path().join("Cargo.toml"),
        format!(
            "[package]\nname = \"consumer\"\nedition = \"2024\"\n[[bin]]\nname = \"consumer\"\npath = \"main.rs\"\n\
             [dependencies]\ndashpot-core = {{ path = {core:?}, default-features = false }}\n[workspace]\n"
        ),
    )
    .unwrap();
    std::fs::copy(
        manifest.parent().unwrap().join("Cargo.lock"),
        folder.path().join("Cargo.lock"),
    )
    .unwrap();
    std::fs::write(
        folder.path().join("main.rs"),
        "include!(\"damper.rs\");\nfn main() {\n let mut state = IN_SERVICE.at_rest(0.0);\n\
         for line in std::io::stdin().lines() {\n let x = f32::from_bits(line.unwrap().parse().unwrap());\n\
         println!(\"{}\", IN_SERVICE.step(&mut state, x).to_bits());\n }\n}\n",
    )
    .unwrap();
    let motion: Vec<f32> = Excitation::Ride
        .displacements_m(1e-3)
        .into_iter()
        .map(|x| x as f32)
        .collect();
    let input = folder.path().join("input");
    let bits: Vec<String> = motion.iter().map(|x| x.to_bits().to_string()).collect();
    std::fs::write(&input, bits.join("\n")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline", "--manifest-path"])
        .arg(folder.path().join("Cargo.toml"))
        .env("CARGO_TARGET_DIR", folder.path().join("target"))
        .stdin(std::fs::File::open(&input).unwrap())
        .assert()
        .success();
    let damper: dashpot_core::Damper<f32> = dashpot_files::damper::load("in-service", &[])
        .unwrap()
        .build(1e-3)
        .unwrap();
    let mut state = damper.at_rest(0.0);
    let expected: Vec<u32> = motion
        .iter()
        .map(|x| damper.step(&mut state, *x).to_bits())
        .collect();
    let found: Vec<u32> = text_of(&output)
        .lines()
        .map(|line| line.parse().unwrap())
        .collect();
    assert_eq!(found, expected);
}

/// The in-service damper as the command writes it.
fn exported(lang: &str, more: &[&str]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("damper");
    let arguments = [
        "export",
        "--damper",
        "in-service",
        "--lang",
        lang,
        "--output",
    ];
    dashpot(
        &[&arguments[..], &[file.to_str().unwrap()], more].concat(),
        Path::new("."),
    )
    .success();
    std::fs::read(file).unwrap()
}

fn in_service<T: dashpot_core::Real>() -> dashpot_core::Damper<T> {
    let parameters = dashpot_files::damper::load("in-service", &[]).unwrap();
    parameters.build(1e-3).unwrap()
}

#[test]
fn the_exported_bytes_are_the_damper() {
    let read = dashpot_core::Damper::<f32>::from_image(&exported("bin", &[]));
    assert_eq!(read, Ok(in_service()));
    let read = dashpot_core::Damper::<f64>::from_image(&exported("bin", &["--scalar", "f64"]));
    assert_eq!(read, Ok(in_service()));
}
