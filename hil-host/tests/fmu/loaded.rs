//! An FMU whose constants are images in its resources folder.

use std::fs;

use crate::common::dashpot;
use crate::driver::{Driver, hexadecimal};
use crate::{Unpacked, bits, displacements_m, forces_n};

fn lines() -> String {
    displacements_m()
        .iter()
        .map(|x| format!("{x:e}\n"))
        .collect()
}

#[test]
fn another_image_is_another_damper() {
    let fmu = Unpacked::new("3", &["--loadable"]);
    let driver = Driver::new("3");
    let forces = |fmu: &Unpacked| {
        let text = driver.run(fmu, &["run", "1"], &lines());
        hexadecimal(&text)
    };
    assert_eq!(
        bits(&forces(&fmu)),
        bits(&forces_n("in-service", &displacements_m()))
    );
    for name in ["paper", "reduced-vertical", "reduced-lateral", "calibrated"] {
        let line = [
            "export",
            "--damper",
            name,
            "--lang",
            "bin",
            "--output",
            "resources/image_1.bin",
        ];
        dashpot(&line, fmu.folder.path()).success();
        assert_eq!(
            bits(&forces(&fmu)),
            bits(&forces_n(name, &displacements_m())),
            "{name}"
        );
    }
}

#[test]
fn an_unsuitable_image_is_refused_with_the_reason() {
    let fmu = Unpacked::new("2", &["--loadable"]);
    let driver = Driver::new("2");
    let image = fmu.path("resources/image_1.bin");
    let whole = fs::read(&image).unwrap();
    let mut damaged = whole.clone();
    damaged[3000] ^= 4;
    let exported = |more: &[&str]| {
        let line = [
            &[
                "export",
                "--damper",
                "paper",
                "--lang",
                "bin",
                "--output",
                "other.bin",
            ],
            more,
        ]
        .concat();
        dashpot(&line, fmu.folder.path()).success();
        fs::read(fmu.path("other.bin")).unwrap()
    };
    let cases = [
        (b"DASHPOT?".to_vec(), "does not begin with DASH"),
        (whole[..whole.len() - 1].to_vec(), "cut short or too long"),
        ([&whole[..], b"x"].concat(), "cut short or too long"),
        (damaged, "its checksum is wrong"),
        (exported(&["--step-us", "500"]), "for a different step"),
        (
            exported(&["--scalar", "f64"]),
            "allowed: one exported in f32",
        ),
    ];
    for (content, expected) in cases {
        fs::write(&image, content).unwrap();
        let text = driver.run(&fmu, &["run", "1"], "");
        assert!(
            text.contains(expected) && text.contains("no instance"),
            "{text}"
        );
        assert!(text.contains("image_1.bin"), "{text}");
    }
    fs::remove_file(&image).unwrap();
    assert!(
        driver
            .run(&fmu, &["run", "1"], "")
            .contains("cannot be read")
    );
}
