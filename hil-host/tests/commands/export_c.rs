//! `dashpot export --lang c` as a command: source and header are compiled and run.

use std::path::Path;
use std::process::Command;

use assert_cmd::assert::Assert;
use predicates::str::contains;

use crate::common::{dashpot, files_in, json_of, json_on_stderr, text_of};

const EXPORT: [&str; 5] = ["export", "--damper", "in-service", "--lang", "c"];

fn export(more: &[&str], folder: &Path) -> Assert {
    dashpot(&[&EXPORT[..], more].concat(), folder)
}

/// Compilers with warnings as errors, for the oldest supported language versions and newer ones.
const COMPILERS: [(xtask::tools::Tool, [&str; 2]); 4] = [
    (xtask::tools::GCC, ["-xc", "-std=c99"]),
    (xtask::tools::GCC, ["-xc", "-std=c11"]),
    (xtask::tools::GXX, ["-xc++", "-std=c++11"]),
    (xtask::tools::GXX, ["-xc++", "-std=c++17"]),
];
const WARNINGS: [&str; 6] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wundef",
    "-Werror",
];

/// Source and header, used from another file and included in one: each program prints the array.
#[test]
fn the_array_is_the_damper_in_c_and_cpp() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    export(&["--name", "MY_DAMPER", "--output", "damper.c"], folder).success();
    for file in ["damper.c", "damper.h"] {
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        for part in ["in-service", "1000 us", "--name MY_DAMPER", "do not edit"] {
            assert!(text.contains(part), "no {part} in {file}");
        }
    }
    let bytes = folder.join("damper.bin");
    let arguments = [
        "export",
        "--damper",
        "in-service",
        "--lang",
        "bin",
        "--output",
    ];
    dashpot(&[&arguments[..], &["damper.bin"]].concat(), folder).success();
    let bytes = std::fs::read(bytes).unwrap();

    let print = "#include <stdio.h>\nint main(void) {\n\
                 return fwrite(MY_DAMPER, 1, sizeof MY_DAMPER, stdout) != sizeof MY_DAMPER;\n}\n";
    let program = |includes: &str| format!("{includes}{print}");
    let apart = program("#include \"damper.h\"\n#include \"damper.h\"\n");
    std::fs::write(folder.join("apart.c"), apart).unwrap();
    let in_one = program("#include \"damper.h\"\n#include \"damper.c\"\n");
    std::fs::write(folder.join("in_one.c"), in_one).unwrap();
    for (tool, options) in COMPILERS {
        if !xtask::tools::have(&[tool], "exported C source, compiled and run") {
            continue;
        }
        for sources in [&["apart.c", "damper.c"][..], &["in_one.c"]] {
            let mut compiler = Command::new(tool.program);
            compiler.args(options).args(WARNINGS).args(sources);
            let compiled = compiler.args(["-o", "main"]).current_dir(folder).output();
            let compiled = compiled.unwrap();
            let messages = String::from_utf8_lossy(&compiled.stderr);
            assert!(compiled.status.success(), "{options:?}: {messages}");
            let run = Command::new(folder.join("main")).output().unwrap();
            assert!(run.status.success() && run.stdout == bytes, "{options:?}");
        }
    }
}

#[test]
fn the_report_names_the_header() {
    let folder = tempfile::tempdir().unwrap();
    let output = export(&["--output", "a.cpp"], folder.path());
    let text = text_of(&output);
    assert!(
        text.starts_with("IN_SERVICE in a.cpp, declared in a.h: in-service"),
        "{text}"
    );
    let output = export(&["--output", "b.c", "--format", "json"], folder.path());
    assert_eq!(json_of(&output)["header"], "b.h");
    let output = export(&["--output", "-", "--format", "json"], folder.path());
    let report = json_on_stderr(&output);
    assert_eq!(report.get("header"), None, "{report}");
    assert_eq!(files_in(folder.path()), ["a.cpp", "a.h", "b.c", "b.h"]);
}

#[test]
fn source_and_header_are_both_written_or_neither() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("x.c"), "kept").unwrap();
    std::fs::create_dir(folder.join("x.h")).unwrap();
    export(&["--output", "x.c"], folder)
        .code(1)
        .stderr(contains("x.h: cannot write: it is not a file"));
    assert_eq!(std::fs::read_to_string(folder.join("x.c")).unwrap(), "kept");
    assert_eq!(files_in(folder), ["x.c", "x.h"]);

    export(&["--output", "y.h"], folder)
        .code(2)
        .stderr(contains("--output y.h: this is the name of the header"));
    assert_eq!(files_in(folder), ["x.c", "x.h"]);
}

#[test]
fn names_that_headers_define_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in [
        "DASHPOT_IMAGE_SIZE",
        "DASHPOT_H",
        "NULL",
        "UINT8_MAX",
        "lower",
        "",
    ] {
        export(&["--name", name, "--output", "x.c"], folder.path())
            .code(2)
            .stderr(contains("allowed: "));
    }
    assert!(files_in(folder.path()).is_empty());
}
