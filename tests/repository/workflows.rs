//! The workflows of a forge are valid, and run only what a developer runs.

use std::fs;
use std::process::Command;

use dashpot::document::in_repository;
use xtask::python::have_packages;

const FOLDER: &str = ".github/workflows";

/// What a step of a workflow may run. The last makes the draft of a release, which only the forge can.
const ALLOWED: [&str; 5] = [
    ".ci/run",
    "cargo xtask advisories",
    "cargo xtask dist",
    "cargo xtask release-checks",
    "gh release create",
];

#[test]
fn workflows_run_only_what_developers_run() {
    let mut ran = Vec::new();
    for file in fs::read_dir(in_repository(FOLDER)).unwrap() {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        let lines = text.lines().map(str::trim);
        ran.extend(lines.filter_map(|line| line.strip_prefix("run: ").map(str::to_owned)));
    }
    for command in &ran {
        let is_allowed = ALLOWED.iter().any(|allowed| command.starts_with(allowed));
        assert!(is_allowed, "`{command}`, allowed: {ALLOWED:?}");
    }
    for allowed in ALLOWED {
        assert!(
            ran.iter().any(|command| command.starts_with(allowed)),
            "{allowed}"
        );
    }
}

#[test]
fn linters_accept_the_workflows() {
    let Some(python) = have_packages("the forge's workflows are not checked") else {
        return;
    };
    let scripts = python.parent().unwrap();
    let lint = |program: &str, arguments: &[&str]| {
        let mut linter = Command::new(scripts.join(program));
        linter.args(arguments).current_dir(in_repository(""));
        let output = linter.output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr);
        (output.status.success(), text)
    };
    for file in ["checks.yml", "release.yml"] {
        let path = format!("{FOLDER}/{file}");
        let schema = ["--builtin-schema", "vendor.github-workflows", &path];
        let (accepted, text) = lint("check-jsonschema", &schema);
        assert!(accepted, "{path}: {text}");
    }
    let (accepted, text) = lint("zizmor", &["--offline", FOLDER]);
    assert!(accepted, "{text}");
}
