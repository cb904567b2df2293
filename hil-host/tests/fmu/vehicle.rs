//! A vehicle and a damper as two FMUs: the commands of docs/fmu.md, results equal to those of `dashpot vehicle` bit for
//! bit, the end of a run, and rejected exports.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use xtask::python::have_packages;

use crate::common::page::blocks;
use crate::common::{self, dashpot, error_of, program};
use crate::source;

/// Returns the vehicle library, built once.
pub fn library() -> &'static Path {
    static LIBRARY: LazyLock<PathBuf> =
        LazyLock::new(|| common::library::library("libdashpot_vehicle_model.a", "fmu"));
    &LIBRARY
}

/// Exports the FMU of a case with these external dampers into `folder`.
fn export(folder: &Path, fmi: &str, case: &str, outside: &[&str]) {
    let mut line = vec!["export", "--fmi", fmi, "--case", case, "--output", "it.fmu"];
    let library = library().to_str().unwrap();
    line.extend(["--library", library]);
    for damper in outside {
        line.extend(["--outside", damper]);
    }
    dashpot(&line, folder).success();
}

/// Columns of a CSV file by name.
fn columns(path: &Path) -> Vec<(String, Vec<u64>)> {
    let mut rows = csv::Reader::from_path(path).unwrap();
    let names = rows.headers().unwrap().clone();
    let mut columns: Vec<(String, Vec<u64>)> = names
        .iter()
        .map(|name| (name.to_owned(), Vec::new()))
        .collect();
    for row in rows.records() {
        for ((_, column), number) in columns.iter_mut().zip(&row.unwrap()) {
            column.push(number.parse::<f64>().unwrap().to_bits());
        }
    }
    columns
}

/// Runs the commands of the page in a folder where `cargo` has already built everything.
#[test]
fn the_page_couples_a_vehicle_and_a_damper_to_the_bits_of_the_command() {
    let Some(python) = have_packages("FMUs of a vehicle and a damper coupled by FMPy") else {
        return;
    };
    let page = fs::read_to_string(source("../docs/fmu.md")).unwrap();
    let lines = page.lines().filter_map(|line| line.strip_prefix("    "));
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("target/release")).unwrap();
    symlink(library(), at("target/release/libdashpot_vehicle_model.a")).unwrap();
    symlink(source("../docs"), at("docs")).unwrap();
    fs::create_dir(at("bin")).unwrap();
    fs::write(at("bin/cargo"), "#!/bin/sh\n").unwrap();
    fs::set_permissions(at("bin/cargo"), fs::Permissions::from_mode(0o755)).unwrap();
    symlink(program(), at("bin/dashpot")).unwrap();
    let path = [&at("bin"), python.parent().unwrap()].map(|folder| folder.to_owned());
    let others = std::env::var_os("PATH").unwrap();
    let path = path.into_iter().chain(std::env::split_paths(&others));
    let path = std::env::join_paths(path).unwrap();
    let run = |line: &str| {
        let mut shell = Command::new("sh");
        shell
            .args(["-ec", line])
            .current_dir(folder.path())
            .env("PATH", &path)
            .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
        let output = shell.output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}: {message}");
    };
    // Lines of the Python block are not commands.
    for line in lines.filter(|line| {
        ["cargo ", "dashpot ", "fmpy ", "python3 "]
            .iter()
            .any(|word| line.starts_with(word))
    }) {
        run(line);
    }
    // Run the Python block of the page, and replay its motion with the command to compare the forces.
    let blocks = blocks(&page);
    let block = blocks.iter().find(|block| block.language == "python");
    let script = format!(
        "{}\nrows = np.column_stack([time, displacement_m])\n\
         np.savetxt('motion.csv', rows, '%.17g', ',', header='time_s,displacement_m', comments='')\n\
         np.savetxt('force_fmpy.csv', force_n, '%.17g', header='force_n', comments='')\n",
        block.unwrap().content
    );
    fs::write(at("motion.py"), script).unwrap();
    for line in [
        "python3 motion.py",
        "dashpot replay --damper in-service --input motion.csv --output force.csv",
    ] {
        run(line);
    }
    let force = |name: &str| {
        let columns = columns(&at(name));
        let (_, bits) = columns
            .into_iter()
            .find(|(name, _)| name == "force_n")
            .unwrap();
        bits.into_iter()
            .map(|bits| f64::from_bits(bits) as f32)
            .collect::<Vec<f32>>()
    };
    assert_eq!(force("force_fmpy.csv"), force("force.csv"));
    assert_eq!(force("force.csv").len(), 3000);
    let coupled = columns(&at("coupled.csv"));
    let history = columns(&at("dashpot-vehicle/history.csv"));
    let of_history = |name: &str| history.iter().find(|(other, _)| other == name);
    let mut compared = 0;
    for (name, bits) in &coupled {
        let Some((_, expected)) = of_history(name) else {
            panic!("{name} is not in the history");
        };
        assert_eq!(bits, expected, "{name}");
        compared += 1;
    }
    // All columns except the time and the filtered forces.
    let filtered = history
        .iter()
        .filter(|(name, _)| name.contains("_filtered_"));
    assert_eq!(compared, history.len() - 1 - filtered.count());
    assert_eq!(history[0].1.len(), 5000);
}

/// Both versions give the same values, the velocity is the rate of displacement over the last step, and a run ends when
/// the vehicle leaves the rails. FMPy checks the rest.
#[test]
fn fmpy_simulates_both_versions_to_the_end_of_the_run() {
    let Some(python) = have_packages("FMUs of a vehicle by FMPy") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let text = "name = \"too fast\"\nvehicle = \"locomotive\"\ntrack = \"curve-r200\"\nspeed_km_h = 200\nduration_s = \
     5.0003\n";
    fs::write(folder.path().join("fast.toml"), text).unwrap();
    let mut outputs = Vec::new();
    for fmi in ["2", "3"] {
        let outside = ["front lateral damper 1", "rear vertical damper 2"];
        export(folder.path(), fmi, "fast.toml", &outside);
        let mut judge = Command::new(&python);
        judge
            .arg(source("tests/fmu/vehicle_judge.py"))
            .arg("it.fmu");
        let output = judge.current_dir(folder.path()).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "FMI {fmi}: {text}");
        outputs.push(String::from_utf8(output.stdout).unwrap());
    }
    for line in [
        "case.json b' ' case.json: not the case that this FMU was exported with\n",
        ".tables b' ' : contact tables: damaged, or contact tables of other profiles or of another version\n",
        ".tables None : No such file or directory",
    ] {
        assert!(outputs[0].contains(line), "{line} in {}", outputs[0]);
    }
    assert_eq!(outputs[0], outputs[1]);
    // Without external dampers, the command gives the same result.
    fs::write(
        folder.path().join("none.csv"),
        "time_s,force_n\n0,0\n10,0\n",
    )
    .unwrap();
    let run = dashpot(
        &[
            "vehicle",
            "--case",
            "fast.toml",
            "--no-page",
            "--outside",
            "front lateral damper 1=none.csv",
            "--outside",
            "rear vertical damper 2=none.csv",
        ],
        folder.path(),
    )
    .code(1);
    let error = error_of(&run);
    let time_s = outputs[0]
        .split_once("ended at ")
        .unwrap()
        .1
        .split(' ')
        .next()
        .unwrap();
    assert!(
        error.contains(&format!("left the tables of the contact at {time_s} s")),
        "{error} {}",
        outputs[0]
    );
}

#[test]
fn invalid_vehicle_exports_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("it.a"), "no library").unwrap();
    // Names that differ only in characters that variable names cannot have.
    let vehicle = fs::read_to_string(source("../data/vehicles/locomotive.toml")).unwrap();
    let vehicle = vehicle.replace("\"front lateral damper\"", "\"Dämpfer\"");
    let vehicle = vehicle.replace("\"rear lateral damper\"", "\"Dümpfer\"");
    fs::write(folder.path().join("vehicle.toml"), vehicle).unwrap();
    let text = "name = \"own\"\nvehicle = \"vehicle.toml\"\ntrack = \"ideal\"\nspeed_km_h = 100\n";
    fs::write(folder.path().join("own.toml"), text).unwrap();
    // `@` is replaced by the options for an existing external damper.
    let one = "--outside front_lateral_damper_1";
    for (code, words, expected) in [
        (
            2,
            "--fmi 3 --case straight-180",
            "--case requires at least one --outside DAMPER",
        ),
        (
            2,
            "--fmi 3 @",
            "--outside applies to the FMU of a vehicle only and requires --case",
        ),
        (
            2,
            "--lang c --case straight-180",
            "--case applies to FMUs only and requires --fmi",
        ),
        (
            2,
            "--fmi 3 --case straight-180 @ --damper paper",
            "cannot be used with",
        ),
        (
            1,
            "--fmi 3 --case straight-180 @ --library none.a",
            "none.a: vehicle library not found; give it with --library FILE",
        ),
        (
            2,
            "--fmi 3 --case none @ --library it.a",
            "case `none`: no such case or file",
        ),
        (
            1,
            "--fmi 3 --case straight-180 --outside front_lateral --library it.a",
            "no damper `front lateral`; did you mean `front lateral",
        ),
        (
            1,
            "--fmi 3 --case own.toml --outside Dämpfer_1 --library it.a",
            "two signals are called D_mpfer_1_displacement_m; allowed: names that differ in letters A to Z and digits",
        ),
        (
            1,
            "--fmi 3 --case straight-180 @ @ --library it.a",
            "the damper is given twice; allowed: once",
        ),
        (
            1,
            "--fmi 3 --case straight-180 @ --library it.a",
            "the C compiler cc failed",
        ),
    ] {
        let line = format!("export --output it.fmu {}", words.replace('@', one));
        let line: Vec<String> = line.split(' ').map(|word| word.replace('_', " ")).collect();
        let line: Vec<&str> = line.iter().map(String::as_str).collect();
        let error = error_of(&dashpot(&line, folder.path()).code(code));
        assert!(error.contains(expected), "{words}: {error}");
        assert!(!folder.path().join("it.fmu").exists());
    }
}

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
/// Symbols of the Rust runtime are hidden, because programs may load several such libraries.
#[test]
fn only_functions_of_the_interface_are_visible() {
    let folder = tempfile::tempdir().unwrap();
    export(
        folder.path(),
        "3",
        "straight-180",
        &["front lateral damper 1"],
    );
    let file = fs::File::open(folder.path().join("it.fmu")).unwrap();
    zip::ZipArchive::new(file)
        .unwrap()
        .extract(folder.path())
        .unwrap();
    let binary = folder.path().join("binaries/x86_64-linux/straight_180.so");
    let mut nm = Command::new("nm");
    nm.args(["--dynamic", "--defined-only", "--format=just-symbols"])
        .arg(binary);
    let names = String::from_utf8(nm.output().unwrap().stdout).unwrap();
    assert_eq!(
        names
            .lines()
            .filter(|name| name.starts_with("fmi3"))
            .count(),
        75
    );
    assert!(
        names.lines().all(|name| name.starts_with("fmi3")),
        "{names}"
    );
    assert!(!folder.path().join("sources").exists());
}
