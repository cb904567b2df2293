//! Fixed bug: clang silently compiled the portable C with `-funsafe-math-optimizations` or its part
//! `-fassociative-math`, and the forces changed. clang defines no macro for these options that an `#error` could test,
//! so the source turns them off with pragmas.

use std::process::Command;

use dashpot::controller::succeed;
use xtask::tools::{AARCH64_GCC, AARCH64_LIBC, CLANG, GCC, QEMU_AARCH64, have};

use crate::standalone::{compiler, two_dampers};

/// Each of these options allows a compiler to change sums, quotients or signs of zeros.
const OPTIONS: [&[&str]; 5] = [
    &["-funsafe-math-optimizations"],
    &[
        "-fassociative-math",
        "-fno-signed-zeros",
        "-fno-trapping-math",
    ],
    &["-freciprocal-math"],
    &["-fno-signed-zeros"],
    &["-fapprox-func", "-ffp-contract=fast"],
];

/// Exit code of the program with both dampers: 0 if both digests are right.
fn run(options: &[&str], emulator: Option<&str>, changed: impl Fn(String) -> String) -> i32 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    two_dampers(folder);
    for name in ["front.c", "rear.c"] {
        let file = folder.join(name);
        let text = std::fs::read_to_string(&file).expect("it was exported");
        std::fs::write(&file, changed(text)).expect("a writable folder");
    }
    let mut clang = compiler(CLANG, &["-std=c99"]);
    clang.args(options).args(["front.c", "rear.c", "main.c"]);
    succeed(clang.args(["-o", "program"]).current_dir(folder));
    let program = folder.join("program");
    let mut run = match emulator {
        Some(emulator) => Command::new(emulator),
        None => Command::new(&program),
    };
    if emulator.is_some() {
        run.arg(&program);
    }
    run.status().expect("it starts").code().expect("it ends")
}

#[test]
fn the_forces_keep_their_bits_whatever_clang_may_reorder() {
    if !have(&[CLANG], "options of clang that change forces") {
        return;
    }
    for options in OPTIONS {
        for level in ["-O2", "-O3"] {
            let code = run(&[&[level][..], options].concat(), None, |text| text);
            assert_eq!(code, 0, "{level} {options:?}");
        }
    }
}

#[test]
fn on_64_bit_arm_too() {
    let tools = [CLANG, AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64];
    if !have(&tools, "options of clang that change forces, on Arm") {
        return;
    }
    let target = ["--target=aarch64-linux-gnu", "-static", "-O2"];
    for options in &OPTIONS[..3] {
        let line = [&target[..], *options].concat();
        let code = run(&line, Some(QEMU_AARCH64.program), |text| text);
        assert_eq!(code, 0, "{options:?}");
    }
}

/// Checks the test itself: without the pragmas the digest is wrong.
#[test]
#[cfg(target_arch = "x86_64")]
fn without_the_pragmas_the_digest_differs() {
    if !have(&[CLANG], "reordered sums found out by the digest") {
        return;
    }
    let without = |text: String| {
        let kept = |line: &&str| !line.contains("float_control") && !line.contains("clang fp");
        let kept: Vec<&str> = text.lines().filter(kept).collect();
        assert!(
            kept.len() + 3 <= text.lines().count(),
            "the pragmas are there"
        );
        kept.join("\n") + "\n"
    };
    for options in &OPTIONS[..2] {
        let code = run(&[&["-O2"][..], *options].concat(), None, without);
        assert_eq!(code, 1, "{options:?}");
    }
}

/// gcc defines macros for its fast-math options, so the source makes each of them an error.
#[test]
fn gcc_refuses_options_that_it_has_macros_for() {
    if !have(&[GCC], "options of gcc that change forces") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    two_dampers(folder.path());
    for options in &OPTIONS[..4] {
        let mut gcc = compiler(GCC, &["-std=c99", "-c", "-o", "front.o"]);
        let output = gcc.args(*options).arg("front.c").current_dir(folder.path());
        let output = output.output().expect("it starts");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{options:?}");
        assert!(
            message.contains("would not be those of the model"),
            "{options:?}: {message}"
        );
    }
}
