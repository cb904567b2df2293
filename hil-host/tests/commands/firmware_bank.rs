//! The dampers linked into the images are those that `dashpot export` writes now.

use std::path::Path;

use crate::common::dashpot;

#[test]
fn export_gives_the_banks_of_the_firmware_again() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (of, damper) in [
        ("src/bank", "in-service"),
        ("src/bank", "reduced-vertical"),
        ("src/bank", "reduced-lateral"),
        ("nucleo-h753zi/src", "in-service"),
    ] {
        // The file contains its own path, so the export runs in a folder where this path is free.
        std::fs::create_dir_all(folder.path().join("firmware").join(of)).unwrap();
        let file = format!("firmware/{of}/{}.rs", damper.replace('-', "_"));
        let arguments = ["export", "--damper", damper, "--lang", "rust"];
        let step = ["--step-us", "1000", "--output", &file];
        dashpot(&[&arguments[..], &step].concat(), folder.path()).success();
        let exported = std::fs::read_to_string(folder.path().join(&file)).unwrap();
        let kept = std::fs::read_to_string(repository.join(&file)).unwrap();
        assert!(
            exported == kept,
            "{file} is out of date: dashpot export --damper {damper} --lang rust --step-us 1000 --output {file}"
        );
    }
}
