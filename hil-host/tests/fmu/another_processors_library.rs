//! Regression: a compiler for another processor (`CC=aarch64-linux-gnu-gcc`) gave an FMU whose folder `x86_64-linux`
//! contained an Arm library, which cannot be loaded, and the export reported success.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

use xtask::tools::{AARCH64_GCC, AARCH64_LIBC, ARM_GCC, ARM_LIBC, GCC, have};

use crate::common::command;

fn export(folder: &Path, compiler: &str, more: &[&str]) -> Output {
    let line = ["export", "--fmi", "3", "--output", "it.fmu"];
    let mut export = command(&[&line[..], more].concat(), folder);
    export.env("CC", compiler).output().unwrap()
}

#[test]
fn a_library_for_another_processor_is_refused_with_what_was_found() {
    let folder = tempfile::tempdir().unwrap();
    let mut compilers = Vec::new();
    if have(
        &[AARCH64_GCC, AARCH64_LIBC],
        "a library for another processor",
    ) {
        compilers.push((
            "aarch64-linux-gnu-gcc",
            "ELF, 64 bit, aarch64, a shared library",
        ));
    }
    if have(&[ARM_GCC, ARM_LIBC], "a library for a microcontroller") {
        compilers.push(("arm-none-eabi-gcc", "ELF, 32 bit, arm, a shared library"));
    }
    for (compiler, found) in compilers {
        if found.contains(std::env::consts::ARCH) {
            continue;
        }
        let output = export(folder.path(), compiler, &["--damper", "in-service"]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{compiler}: {text}");
        assert!(text.contains(compiler), "{text}");
        assert!(text.contains(found), "{text}");
        let needed = format!("but {}-", std::env::consts::ARCH);
        assert!(text.contains(&needed), "{text}");
        assert!(text.contains("in the variable CC"), "{text}");
        assert!(text.contains("--sources-only"), "{text}");
        assert!(output.stdout.is_empty());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        // If the FMU has no library for this platform, any compiler is accepted.
        let sources = ["--damper", "in-service", "--sources-only"];
        assert!(export(folder.path(), compiler, &sources).status.success());
        fs::remove_file(folder.path().join("it.fmu")).unwrap();
    }
}

/// A compiler may also produce something that is not a shared library.
#[test]
fn an_object_file_in_place_of_a_library_is_refused() {
    if !have(&[GCC], "an object file in place of a library") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let compiler = folder.path().join("compiler");
    let script = "#!/bin/sh\nwhile [ \"$1\" != -o ]; do shift; done\necho 'int it;' | gcc -x c -c -o \"$2\" -\n";
    fs::write(&compiler, script).unwrap();
    fs::set_permissions(&compiler, fs::Permissions::from_mode(0o755)).unwrap();
    let named = compiler.to_str().unwrap();
    let output = export(folder.path(), named, &["--damper", "in-service"]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("not a shared library"), "{text}");
    assert!(!folder.path().join("it.fmu").exists());
}

#[test]
fn a_library_of_vehicles_for_another_processor_is_refused() {
    let tools = [AARCH64_GCC, AARCH64_LIBC];
    if std::env::consts::ARCH == "aarch64" || !have(&tools, "a foreign library of vehicles") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("it.c"), "int it;\n").unwrap();
    for line in [
        ["aarch64-linux-gnu-gcc", "-c", "it.c"],
        ["aarch64-linux-gnu-ar", "rc", "it.a it.o"],
    ] {
        let mut words = line.iter().flat_map(|words| words.split(' '));
        let mut built = Command::new(words.next().unwrap());
        built.args(words).current_dir(folder.path());
        assert!(built.status().unwrap().success());
    }
    let case = [
        "--case",
        "straight-180",
        "--outside",
        "front lateral damper 1",
    ];
    let line = [&case[..], &["--library", "it.a"]].concat();
    let output = export(folder.path(), "", &line);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{text}");
    let expected = "it.a: the vehicle library contains object files of another type (ELF, 64 bit, aarch64, not a \
                    shared library)";
    assert!(text.contains(expected), "{text}");
    assert!(!folder.path().join("it.fmu").exists());
}
