//! Checks that the committed header equals the one cbindgen generates from the sources, with the version and sizes of
//! this library.
//!
//! `DASHPOT_BLESS=1 cargo test --manifest-path capi/Cargo.toml --test header` writes the header.

use std::fmt::{Display, Write};
use std::path::Path;

/// Definitions that cbindgen cannot generate: the version from cargo and the sizes from the compiler.
fn version_and_sizes() -> String {
    let mut text = String::new();
    let mut define = |comment: &str, name: &str, value: &dyn Display| {
        write!(
            text,
            "\n/**\n * {comment}\n */\n#define DASHPOT_{name} {value}\n"
        )
        .unwrap();
    };
    for (name, value) in [
        ("MAJOR", env!("CARGO_PKG_VERSION_MAJOR")),
        ("MINOR", env!("CARGO_PKG_VERSION_MINOR")),
        ("PATCH", env!("CARGO_PKG_VERSION_PATCH")),
    ] {
        let part = name.to_lowercase();
        let comment = format!("Version of this header, {part} number.");
        define(&comment, &format!("VERSION_{name}"), &value);
    }
    define(
        "Version of this header as one number: 10000 major + 100 minor + patch.",
        "VERSION",
        &"\\\n    (10000 * DASHPOT_VERSION_MAJOR + 100 * DASHPOT_VERSION_MINOR + DASHPOT_VERSION_PATCH)",
    );
    define(
        "Checks the linked library against this header: DASHPOT_ERROR_NONE or DASHPOT_ERROR_HEADER.",
        "CHECK_HEADER()",
        &"\\\n    dashpot_check_header(DASHPOT_VERSION, sizeof(dashpot_damper), sizeof(dashpot_state))",
    );
    for (name, value, comment) in [
        (
            "DAMPER_SIZE",
            dashpot::DASHPOT_DAMPER_SIZE,
            "Size of a dashpot_damper (bytes).",
        ),
        (
            "DAMPER_ALIGN",
            align_of::<dashpot::DashpotDamper>(),
            "Alignment of a dashpot_damper (bytes).",
        ),
        (
            "DAMPER_WORDS",
            dashpot::DASHPOT_DAMPER_WORDS,
            "Size of a dashpot_damper (words).",
        ),
        (
            "STATE_SIZE",
            dashpot::DASHPOT_STATE_SIZE,
            "Size of a dashpot_state (bytes).",
        ),
        (
            "STATE_ALIGN",
            align_of::<dashpot::DashpotState>(),
            "Alignment of a dashpot_state (bytes).",
        ),
        (
            "STATE_WORDS",
            dashpot::DASHPOT_STATE_WORDS,
            "Size of a dashpot_state (words).",
        ),
        (
            "IMAGE_SIZE",
            dashpot::DASHPOT_IMAGE_SIZE,
            "Size of the image of a damper (bytes).",
        ),
        (
            "SAVED_STATE_SIZE",
            dashpot::DASHPOT_SAVED_STATE_SIZE,
            "Size of a saved state (bytes).",
        ),
        (
            "HEALTH_MODEL_SIZE",
            dashpot::DASHPOT_HEALTH_MODEL_SIZE,
            "Size of a dashpot_health_model (bytes).",
        ),
        (
            "HEALTH_MODEL_WORDS",
            dashpot::DASHPOT_HEALTH_MODEL_WORDS,
            "Size of a dashpot_health_model (words).",
        ),
        (
            "HEALTH_SIZE",
            dashpot::DASHPOT_HEALTH_SIZE,
            "Size of a dashpot_health (bytes).",
        ),
        (
            "HEALTH_WORDS",
            dashpot::DASHPOT_HEALTH_WORDS,
            "Size of a dashpot_health (words).",
        ),
        (
            "HEALTH_IMAGE_SIZE",
            dashpot::DASHPOT_HEALTH_IMAGE_SIZE,
            "Size of the image of a dashpot_health_model (bytes).",
        ),
    ] {
        define(comment, name, &value);
    }
    text
}

#[test]
fn the_header_is_that_of_the_sources() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut config = cbindgen::Config::from_file(here.join("cbindgen.toml")).unwrap();
    config.after_includes = Some(version_and_sizes());
    let bindings = cbindgen::Builder::new()
        .with_crate(here)
        .with_config(config)
        .generate()
        .unwrap();
    let mut generated = Vec::new();
    bindings.write(&mut generated);
    let generated = String::from_utf8(generated).unwrap();
    let file = here.join("include/dashpot.h");
    if std::env::var_os("DASHPOT_BLESS").is_some_and(|value| value == "1") {
        std::fs::write(&file, &generated).unwrap();
    }
    let checked_in = std::fs::read_to_string(&file).unwrap_or_default();
    // `assert_eq!` would print both whole texts.
    let differs = checked_in
        .lines()
        .zip(generated.lines())
        .position(|(a, b)| a != b);
    assert!(
        checked_in == generated,
        "{} differs from the sources at {}: DASHPOT_BLESS=1 cargo test --manifest-path capi/Cargo.toml --test \
         header",
        file.display(),
        differs.map_or("the end of the shorter one".to_owned(), |line| {
            format!("line {}", line + 1)
        })
    );
}
