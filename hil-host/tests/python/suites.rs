//! The package's own tests, one test per file, under an interpreter with pandas, Dask and type checkers.

use crate::installed::{package, run, unpacked};
use xtask::python::have_packages;

/// Runs a test file, which must contain at least one test.
fn suite(name: &str) {
    let Some(python) = have_packages("the package of Python") else {
        return;
    };
    let path = unpacked();
    let folder = tempfile::tempdir().unwrap();
    let tests = package().join("tests");
    let tests = tests.to_str().unwrap();
    let arguments = [
        "-m",
        "unittest",
        "discover",
        "--start-directory",
        tests,
        "--pattern",
        name,
    ];
    let output = run(&python, folder.path(), Some(path.path()), &arguments);
    assert!(
        output.contains("\nOK\n") && !output.contains("Ran 0 tests"),
        "{output}"
    );
}

macro_rules! suites {
    ($($name:ident),* $(,)?) => {$(
        #[test]
        fn $name() {
            suite(concat!(stringify!($name), ".py"));
        }
    )*};
}

suites!(
    test_analysis,
    test_arrays,
    test_bank,
    test_calibration,
    test_contact,
    test_damper,
    test_documentation,
    test_health,
    test_hybrid,
    test_notebook,
    test_recording,
    test_replay,
    test_rig,
    test_state,
    test_study,
    test_typing,
    test_vehicle,
);

/// Checks that each test file of the package is in the list of `suites!`.
#[test]
fn every_file_of_tests_is_run() {
    let here = include_str!("suites.rs");
    let mut count = 0;
    for entry in std::fs::read_dir(package().join("tests")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if let Some(stem) = name
            .strip_suffix(".py")
            .filter(|stem| stem.starts_with("test_"))
        {
            assert!(here.contains(&format!("\n    {stem},\n")), "{name}");
            count += 1;
        }
    }
    assert!(count > 0);
}

/// Checks that the stubs agree with the compiled package: names, parameters, defaults.
#[test]
fn the_stubs_agree_with_the_package() {
    let Some(python) = have_packages("the stubs of the package of Python") else {
        return;
    };
    let path = unpacked();
    let folder = tempfile::tempdir().unwrap();
    let output = run(
        &python,
        folder.path(),
        Some(path.path()),
        &["-m", "mypy.stubtest", "dashpot"],
    );
    assert!(output.contains("Success: no issues found"), "{output}");
    // Checks that the stubs are used to type-check a user's code.
    let example = folder.path().join("example.py");
    std::fs::write(
        &example,
        "import dashpot\nreveal_type(dashpot.Damper(\"paper\").build().at_rest().force_n)\n",
    )
    .unwrap();
    let arguments = ["-m", "mypy", "--strict", "example.py"];
    let output = run(&python, folder.path(), Some(path.path()), &arguments);
    assert!(
        output.contains("\"builtins.float\"") || output.contains("\"float\""),
        "{output}"
    );
}
