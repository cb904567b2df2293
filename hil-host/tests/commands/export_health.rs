//! `dashpot export --health` as a command: the bytes are those of the model on the host, in every language.

use std::process::Command;

use dashpot_core::health::{HealthModel, HealthSettings};
use dashpot_files::damper;

use crate::common::{dashpot, error_of, json_of, text_of};

const EXPORT: [&str; 9] = [
    "export",
    "--damper",
    "paper",
    "--health",
    "--displacement-noise-m",
    "60e-6",
    "--force-noise-n",
    "50",
    "--lang",
];

fn model() -> HealthModel {
    let parameters = damper::load("paper", &[]).unwrap();
    let settings = HealthSettings::new(60e-6, 50.0)
        .memory_s(3.0)
        .lag(-1e-4, 0.0);
    parameters.health_model(&settings, 5e-4).unwrap()
}

/// The parameters of [`model`].
const MORE: [&str; 8] = [
    "--memory-s",
    "3",
    "--lag-s",
    "-1e-4",
    "--lag-sd-s",
    "0",
    "--step-us",
    "500",
];

/// Numbers between the braces or brackets of a byte array.
fn array(text: &str, from: &str) -> Vec<u8> {
    let (_, array) = text.split_once(from).unwrap();
    let words = array
        .split([',', '\n', ' '])
        .filter_map(|word| word.strip_prefix("0x"));
    words
        .map(|word| u8::from_str_radix(word, 16).unwrap())
        .collect()
}

#[test]
fn the_model_is_the_desks_in_every_language() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let image = model().to_image();
    let export = |lang: &str, output: &str| {
        let arguments = [&EXPORT[..], &[lang], &MORE, &["--output", output]].concat();
        dashpot(&[&arguments[..], &["--format", "json"]].concat(), folder).success()
    };
    let report = json_of(&export("bin", "model.bin"));
    assert_eq!(report["image_bytes"], HealthModel::IMAGE_BYTES);
    assert_eq!(std::fs::read(folder.join("model.bin")).unwrap(), image);

    let report = json_of(&export("c", "model.c"));
    assert_eq!(
        (report["name"].as_str(), report["header"].as_str()),
        (Some("PAPER_HEALTH"), Some("model.h"))
    );
    let source = std::fs::read_to_string(folder.join("model.c")).unwrap();
    assert_eq!(
        array(&source, "const uint8_t PAPER_HEALTH[2236] = {"),
        image
    );
    // The command quoted in the output produces the same bytes again.
    for part in [
        "paper",
        "500 us",
        "--memory-s 3",
        "--lag-s -0.0001",
        "--lag-sd-s 0",
        "do not edit",
    ] {
        assert!(source.contains(part), "no {part}");
    }
    let header = std::fs::read_to_string(folder.join("model.h")).unwrap();
    assert!(
        header.contains("extern const uint8_t PAPER_HEALTH[2236];"),
        "{header}"
    );

    export("rust", "model.rs");
    let source = std::fs::read_to_string(folder.join("model.rs")).unwrap();
    assert_eq!(
        array(&source, "pub static PAPER_HEALTH: [u8; 2236] = ["),
        image
    );
}

/// The C array compiles without warnings and has the same bytes.
#[test]
fn the_array_compiles() {
    use xtask::tools::{GCC, have};
    if !have(&[GCC], "an exported health model, compiled") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let arguments = [&EXPORT[..], &["c"], &MORE, &["--output", "model.c"]].concat();
    dashpot(&arguments, folder).success();
    let main = "#include <stdio.h>\n#include \"model.h\"\nint main(void) {\n\
                return fwrite(PAPER_HEALTH, 1, sizeof PAPER_HEALTH, stdout) != sizeof PAPER_HEALTH;\n}\n";
    std::fs::write(folder.join("main.c"), main).unwrap();
    let mut compiler = Command::new(GCC.program);
    compiler.args([
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Wconversion",
        "-Wundef",
        "-Werror",
    ]);
    compiler
        .args(["main.c", "model.c", "-o", "main"])
        .current_dir(folder);
    assert!(compiler.status().unwrap().success());
    let printed = Command::new(folder.join("main")).output().unwrap();
    assert_eq!(printed.stdout, model().to_image());
}

#[test]
fn incompatible_options_are_wrong_use() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = |arguments: &[&str], code: i32| {
        let all = [arguments, &["--output", "x"]].concat();
        error_of(&dashpot(&all, folder.path()).code(code).stdout(""))
    };
    let without_noise = ["export", "--damper", "paper", "--lang", "bin", "--health"];
    assert!(wrong(&without_noise, 2).contains("--displacement-noise-m"));
    let without_health = [
        "export",
        "--damper",
        "paper",
        "--lang",
        "bin",
        "--displacement-noise-m",
        "1e-5",
        "--force-noise-n",
        "9",
    ];
    assert!(wrong(&without_health, 2).contains("requires --health"));
    let double = [&EXPORT[..], &["bin", "--scalar", "f64"]].concat();
    assert!(wrong(&double, 2).contains("single precision"));
    let step = [&EXPORT[..], &["bin", "--step-us", "5000"]].concat();
    assert!(
        wrong(&step, 2).contains("1e-5 to 2e-3 s"),
        "{}",
        wrong(&step, 2)
    );
    let noise = [&EXPORT[..], &["bin", "--memory-s", "0"]].concat();
    assert!(wrong(&noise, 2).contains("--memory-s 0: allowed: 0.1 to 1e5 s"));
    let named = [&EXPORT[..], &["bin", "--name", "X"]].concat();
    assert!(wrong(&named, 2).contains("bytes have no name"));
    let text = text_of(
        &dashpot(
            &[&EXPORT[..], &["c", "--output", "y.c"]].concat(),
            folder.path(),
        )
        .success(),
    );
    assert_eq!(
        text,
        "PAPER_HEALTH in y.c, declared in y.h: health model of paper for a step of 1000 us: image 2236 bytes, 2224 \
         bytes in memory, 440 bytes per estimate\n"
    );
}
