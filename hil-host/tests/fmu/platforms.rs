//! FMUs for several platforms, and a vehicle with its dampers as one file.

use std::fs;
use std::path::Path;
use std::process::Command;

use xtask::python::have_packages;
use xtask::tools::{AARCH64_GCC, AARCH64_LIBC, GCC, MINGW_GCC, MINGW_OBJDUMP, have};

use crate::common::{dashpot, error_of};
use crate::vehicle::library;
use crate::{Unpacked, source};

const WINDOWS: [&str; 2] = ["--platform", "x86_64-windows=x86_64-w64-mingw32-gcc"];

/// Imported libraries and exported functions of a library for Windows.
fn listed(library: &Path) -> (Vec<String>, usize) {
    let mut list = Command::new(MINGW_OBJDUMP.program);
    let output = list.arg("-p").arg(library).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let imported = text
        .lines()
        .filter_map(|line| line.trim().strip_prefix("DLL Name: "));
    let exported = text.lines().filter(|line| line.contains("] fmi"));
    (imported.map(str::to_lowercase).collect(), exported.count())
}

#[test]
fn one_fmu_has_libraries_for_three_platforms() {
    if !have(
        &[GCC, MINGW_GCC, MINGW_OBJDUMP, AARCH64_GCC, AARCH64_LIBC],
        "an FMU for three platforms",
    ) {
        return;
    }
    let arm = ["--platform", "aarch64-linux=aarch64-linux-gnu-gcc"];
    let fmu = Unpacked::new("3", &[&WINDOWS[..], &arm].concat());
    let elf = |name: &str| fs::read(fmu.path(name)).unwrap()[18];
    assert_eq!(elf("binaries/x86_64-linux/in_service.so"), 62);
    assert_eq!(elf("binaries/aarch64-linux/in_service.so"), 183);
    // Nothing but what every Windows has.
    let (imported, exported) = listed(&fmu.path("binaries/x86_64-windows/in_service.dll"));
    assert_eq!(
        (imported, exported),
        (vec!["kernel32.dll".into(), "msvcrt.dll".into()], 75)
    );
    let fmu = Unpacked::new("2", &WINDOWS);
    let (imported, exported) = listed(&fmu.path("binaries/win64/in_service.dll"));
    assert_eq!(
        (imported, exported),
        (vec!["kernel32.dll".into(), "msvcrt.dll".into()], 34)
    );
    assert!(fmu.path("binaries/linux64/in_service.so").exists());
}

#[test]
fn a_wrong_platform_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |more: &[&str], words: &[&str]| {
        let line = ["export", "--damper", "in-service", "--output", "it.fmu"];
        let error = error_of(&dashpot(&[&line[..], more].concat(), folder.path()).failure());
        for word in words {
            assert!(error.contains(word), "{error}");
        }
        assert!(!folder.path().join("it.fmu").exists());
    };
    refused(
        &["--fmi", "3", "--platform", "win64=cc"],
        &["unknown platform win64", "x86_64", "windows"],
    );
    refused(
        &["--fmi", "3", "--platform", "x86_64-windows"],
        &["PLATFORM=COMPILER"],
    );
    refused(
        &["--fmi", "3", "--platform", "x86_64-windows= "],
        &["no compiler"],
    );
    refused(
        &["--lang", "c", WINDOWS[0], WINDOWS[1]],
        &["--platform", "--fmi"],
    );
    refused(
        &[
            "--fmi",
            "3",
            "--platform",
            "x86-windows=cc",
            "--platform",
            "x86-windows=cc",
        ],
        &["given twice"],
    );
    refused(
        &["--fmi", "2", "--platform", "aarch64-linux=cc"],
        &["FMI 2 has no folder", "--fmi 3"],
    );
    // The host's compiler does not build for Windows.
    let other = [
        "--fmi",
        "3",
        "--platform",
        "x86_64-windows=gcc -fvisibility=hidden",
    ];
    refused(
        &other,
        &["PE, 64 bit, x86_64", "--platform x86_64-windows=COMPILER"],
    );
}

/// FMPy reads the file, connects the parts and steps them in parallel. The force of a damper is then about one step
/// late, so the ride differs a little from that of one program.
#[test]
fn a_vehicle_with_its_dampers_runs_from_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let dampers = [
        "--outside",
        "front lateral damper 1",
        "--outside",
        "front lateral damper 2",
    ];
    let library = library().to_str().unwrap();
    let line = [
        "export",
        "--case",
        "straight-180",
        "--fmi",
        "2",
        "--ssp",
        "--library",
        library,
        "--output",
        "it.ssp",
    ];
    let export = [&line[..], &dampers].concat();
    dashpot(&export, folder.path()).success();
    let first = fs::read(folder.path().join("it.ssp")).unwrap();
    dashpot(&export, folder.path()).success();
    assert_eq!(
        first,
        fs::read(folder.path().join("it.ssp")).unwrap(),
        "the same bytes"
    );
    let Some(python) = have_packages("an SSP file in FMPy") else {
        return;
    };
    let signal = "front_lateral_damper_1_displacement_m";
    let judged = Command::new(python)
        .arg(source("tests/fmu/ssp_judge.py"))
        .args([
            "it.ssp",
            &format!("straight_180.{signal}"),
            "2",
            "signal.txt",
        ])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(
        judged.status.success(),
        "{}",
        String::from_utf8_lossy(&judged.stderr)
    );
    let run = [
        "vehicle",
        "-q",
        "--case",
        "straight-180",
        "--duration-s",
        "2",
        "--no-page",
        "--output",
        "run",
    ];
    dashpot(&run, folder.path()).success();
    let mut rows = csv::Reader::from_path(folder.path().join("run/history.csv")).unwrap();
    let column = rows
        .headers()
        .unwrap()
        .iter()
        .position(|name| name == signal)
        .unwrap();
    let alone = rows
        .records()
        .map(|row| row.unwrap()[column].parse::<f64>().unwrap());
    let text = fs::read_to_string(folder.path().join("signal.txt")).unwrap();
    let coupled = text.lines().map(|line| line.parse::<f64>().unwrap());
    let (mut square, mut difference, mut count) = (0.0, 0.0, 0);
    for (one, other) in alone.zip(coupled) {
        square += one * one;
        difference += (one - other) * (one - other);
        count += 1;
    }
    let error = (difference / square).sqrt();
    assert_eq!(count, 2000);
    assert!((1e-4..1e-2).contains(&error), "{error}");
}
