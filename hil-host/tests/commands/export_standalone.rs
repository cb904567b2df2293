//! `dashpot export --lang c --standalone` as a command: files and messages; the source is compiled and run.

use std::path::Path;
use std::process::Command;

use assert_cmd::assert::Assert;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use crate::common::{dashpot, files_in, json_of, text_of};

const EXPORT: [&str; 6] = [
    "export",
    "--damper",
    "in-service",
    "--lang",
    "c",
    "--standalone",
];

fn export(more: &[&str], folder: &Path) -> Assert {
    dashpot(&[&EXPORT[..], more].concat(), folder)
}

fn read(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap()
}

#[test]
fn header_and_source_are_named_and_always_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = text_of(&export(&["--output", "a.c"], folder));
    assert!(
        text.starts_with(
            "IN_SERVICE in a.c, declared in a.h: in-service for a step of 1000 us, f32"
        ),
        "{text}"
    );
    assert!(
        text.contains(": 12416 bytes of constants, state 24 bytes"),
        "{text}"
    );
    assert!(!text.contains("image"), "{text}");
    let first = [read(folder, "a.c"), read(folder, "a.h")];
    for text in &first {
        assert!(
            text.contains("--lang c --standalone --step-us 1000 --scalar f32"),
            "{text}"
        );
        for token in ["prefix", "PREFIX", "SCALAR_"] {
            assert!(!text.contains(token), "{token} is left");
        }
    }
    assert!(first[0].contains("#include \"a.h\""));
    export(&["--output", "a.c"], folder).success();
    assert_eq!([read(folder, "a.c"), read(folder, "a.h")], first);

    let more = [
        "--scalar", "f64", "--name", "REAR", "--output", "b.c", "--format", "json",
    ];
    let report = json_of(&export(&more, folder));
    assert_eq!(
        (&report["header"], &report["name"]),
        (&"b.h".into(), &"REAR".into())
    );
    assert_eq!(report["state_bytes"], 40);
    assert!(read(folder, "b.h").contains("typedef double rear_real;"));
    assert_eq!(files_in(folder), ["a.c", "a.h", "b.c", "b.h"]);
}

#[test]
fn a_stream_gets_a_source_that_stands_alone() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let source = text_of(&export(&["--output", "-"], folder));
    assert!(!source.contains("#include \""), "it includes a file");
    assert!(files_in(folder).is_empty());
    if !xtask::tools::have(&[xtask::tools::GCC], "C without a library from a stream") {
        return;
    }
    let main = "int main(void)\n{\n    \
        return in_service_digest(&in_service_as_built) == IN_SERVICE_DIGEST ? 0 : 1;\n}\n";
    std::fs::write(folder.join("main.c"), source + main).unwrap();
    let mut compiler = Command::new("gcc");
    compiler.args([
        "-std=c99",
        "-O1",
        "-Wall",
        "-Wextra",
        "-Wconversion",
        "-pedantic",
        "-Werror",
    ]);
    let compiled = compiler
        .args(["main.c", "-o", "main"])
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{compiled:?}");
    assert!(
        Command::new(folder.join("main"))
            .status()
            .unwrap()
            .success()
    );
}

#[test]
fn a_file_that_c_cannot_include_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for file in ["a\"b.c", "a\\b.c", "a\nb.c"] {
        export(&["--output", file], folder.path())
            .code(2)
            .stderr(contains("--output: file ").and(contains("C cannot include it")));
    }
    assert!(files_in(folder.path()).is_empty());
}
