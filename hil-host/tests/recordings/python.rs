//! Files written by asammdf, pyarrow and pandas during the test, and our files read by them.

use std::path::{Path, PathBuf};
use std::process::Command;

use dashpot_recording::Channels;
use xtask::python::have_packages;

use crate::forms::{compare, compare_invalid, rows};
use crate::written::replay;

/// Runs a script in this folder.
pub fn run(python: PathBuf, script: &str, arguments: &[&str]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings");
    let output = Command::new(python)
        .arg(folder.join(script))
        .args(arguments)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{script}: {errors}");
}

#[test]
fn files_of_other_programs_are_read() {
    let Some(python) = have_packages("files of asammdf, pyarrow and pandas") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    // More rows than are read at a time.
    run(
        python,
        "make.py",
        &[folder.path().to_str().unwrap(), "20000"],
    );
    assert_eq!(
        rows(&folder.path().join("expected.csv"), &Channels::default())
            .unwrap()
            .len(),
        20_000
    );
    compare(folder.path());
    compare_invalid(folder.path());
}

#[test]
fn other_programs_read_ours() {
    let Some(python) = have_packages("asammdf and pyarrow reading our files") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    replay(folder.path(), &["force.csv", "force.parquet", "force.mf4"]);
    run(python, "compare.py", &[folder.path().to_str().unwrap()]);
}
