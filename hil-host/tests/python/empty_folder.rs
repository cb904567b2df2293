//! The examples in an environment with only numpy, in an empty folder.

use crate::installed::{alone, package, run, unpacked};
use xtask::python::have_packages;

#[test]
fn the_examples_run_from_an_empty_folder_with_numpy_alone() {
    if have_packages("the examples of the package of Python").is_none() {
        return;
    }
    let environment = tempfile::tempdir().unwrap();
    let python = alone(environment.path());
    let path = unpacked();
    let mut count = 0;
    for entry in std::fs::read_dir(package().join("examples")).unwrap() {
        let example = entry.unwrap().path();
        // A notebook and the examples in folders have tests of their own.
        if example
            .extension()
            .is_none_or(|extension| extension != "py")
        {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let arguments = [example.to_str().unwrap()];
        let output = run(&python, folder.path(), Some(path.path()), &arguments);
        assert!(
            !output.contains("Warning"),
            "{}: {output}",
            example.display()
        );
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn the_example_on_a_cluster_runs_from_an_empty_folder() {
    let Some(python) = have_packages("the example of the package of Python on Dask") else {
        return;
    };
    let (path, folder) = (unpacked(), tempfile::tempdir().unwrap());
    let example = package().join("examples/dask/study.py");
    let arguments = [example.to_str().unwrap()];
    run(&python, folder.path(), Some(path.path()), &arguments);
}
