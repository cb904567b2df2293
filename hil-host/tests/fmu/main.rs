//! FMUs as importers use them: through a driver in C with the official headers, and through FMPy.

mod another_processors_library;
mod bank;
#[path = "../common/mod.rs"]
mod common;
mod driver;
mod forces;
mod judge;
mod loaded;
mod platforms;
mod refused;
mod vehicle;

use std::fs;
use std::path::{Path, PathBuf};

use dashpot_core::Damper;
use dashpot_files::damper;
use dashpot_testbench::excitation::Excitation;

use crate::common::dashpot;

/// An FMU, unpacked into its own folder.
pub struct Unpacked {
    /// Folder of the FMU and its unpacked contents.
    pub folder: tempfile::TempDir,
    /// Contents of modelDescription.xml.
    pub description: String,
}

impl Unpacked {
    /// Exports in-service.fmu with additional options.
    pub fn new(fmi: &str, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let line = [
            &[
                "export",
                "--damper",
                "in-service",
                "--fmi",
                fmi,
                "--output",
                "it.fmu",
            ],
            more,
        ]
        .concat();
        dashpot(&line, folder.path()).success();
        let file = fs::File::open(folder.path().join("it.fmu")).unwrap();
        zip::ZipArchive::new(file)
            .unwrap()
            .extract(folder.path())
            .unwrap();
        let description = fs::read_to_string(folder.path().join("modelDescription.xml")).unwrap();
        Self {
            folder,
            description,
        }
    }

    /// Returns the path of one of its files.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Returns the path of the library for this platform, wherever it is in the FMU.
    pub fn library(&self) -> PathBuf {
        let platforms = fs::read_dir(self.path("binaries")).unwrap();
        let [platform] = &platforms
            .map(|entry| entry.unwrap().path())
            .collect::<Vec<_>>()[..]
        else {
            panic!("one platform");
        };
        let [library] = &fs::read_dir(platform)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect::<Vec<_>>()[..]
        else {
            panic!("one library");
        };
        library.clone()
    }

    /// Token that the interface requires to create an instance.
    pub fn token(&self) -> &str {
        let text = &self.description;
        let from = text
            .split_once("guid=\"")
            .or_else(|| text.split_once("instantiationToken=\""));
        from.unwrap().1.split_once('"').unwrap().0
    }
}

/// Returns part of the ride (m), with a jump that is too fast for any damper to follow.
pub fn displacements_m() -> Vec<f64> {
    let mut ride = Excitation::Ride.displacements_m(1e-3);
    ride.truncate(3000);
    ride[2500] += 0.01;
    ride
}

/// Returns the forces (N) of a preset, stepped through displacements (m) from rest at the first one.
pub fn forces_n(name: &str, displacements_m: &[f64]) -> Vec<f64> {
    let damper: Damper<f32> = damper::load(name, &[]).unwrap().build(1e-3).unwrap();
    let mut state = damper.at_rest(displacements_m[0] as f32);
    let step = |x: &f64| f64::from(damper.step(&mut state, *x as f32));
    displacements_m.iter().map(step).collect()
}

/// Returns the bit pattern of each number.
pub fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Path of a file of this package.
pub fn source(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}
