//! The package contains its licences.

use std::fs::{File, read_to_string};
use std::io::Read;

use xtask::python::have_packages;
use zip::ZipArchive;

use crate::installed::{built, package};

#[test]
fn the_wheel_has_the_licences_of_the_repository() {
    if have_packages("the wheel of the package of Python").is_none() {
        return;
    }
    let mut wheel = ZipArchive::new(File::open(built()).unwrap()).unwrap();
    let names: Vec<String> = wheel
        .file_names()
        .map(|name| name.unwrap().into_owned())
        .collect();
    let mut bytes = |part: &str| {
        let name = names.iter().find(|name| name.contains(part));
        let name = name.unwrap_or_else(|| panic!("no {part}: {names:?}"));
        let mut bytes = Vec::new();
        wheel
            .by_name(name)
            .unwrap()
            .read_to_end(&mut bytes)
            .unwrap();
        bytes
    };
    let mut text = |part: &str| String::from_utf8(bytes(part)).unwrap();
    let metadata = text(".dist-info/METADATA");
    assert!(
        metadata.contains("License-Expression: MIT OR Apache-2.0"),
        "{metadata}"
    );
    for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let packaged = text(&format!(".dist-info/licenses/{licence}"));
        let ours = package().join("..").join(licence);
        assert_eq!(packaged, read_to_string(ours).unwrap());
        assert!(
            metadata.contains(&format!("License-File: {licence}")),
            "{metadata}"
        );
    }
    // Licences of third-party texts are kept with those texts; none of them is in the package.
    let library = bytes("dashpot/_dashpot.");
    for other in ["uPlot", "Modelica Association"] {
        let is_other = |window: &[u8]| window == other.as_bytes();
        assert!(!library.windows(other.len()).any(is_other), "{other}");
    }
}
