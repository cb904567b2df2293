//! Libraries of the workspace that are not part of a test program.

use std::path::PathBuf;

use xtask::run::cargo_output;

/// Builds a library file of the workspace, such as `libdashpot_vehicle_model.a`, and returns its path. `test` is the
/// test program that asks: built together with a test, libraries share all that the tests have compiled.
pub fn library(file: &str, test: &str) -> PathBuf {
    let printed = cargo_output(&[
        "build",
        "--locked",
        "--workspace",
        "--lib",
        "--test",
        test,
        "--message-format",
        "json-render-diagnostics",
    ])
    .unwrap();
    let messages = printed
        .lines()
        .map(|line| serde_json::from_str(line).unwrap());
    let mut files = messages.flat_map(|message: serde_json::Value| {
        let files = message["filenames"].as_array().cloned().unwrap_or_default();
        files
            .into_iter()
            .filter_map(|file| file.as_str().map(PathBuf::from))
    });
    files.find(|path| path.ends_with(file)).unwrap()
}
