//! On every processor that has one the step takes the processor's square root; a build that cannot says so.

use std::path::Path;
use std::process::Command;

use dashpot::target::experiments;
use object::{Object, ObjectSection, ObjectSymbol, SectionKind};
use xtask::processor::{
    AARCH64, CORTEX_M3, CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor, SOFT_FLOAT,
};
use xtask::run::repository;
use xtask::tools::{
    AARCH64_GCC, AARCH64_LIBC, ARM_GCC, QEMU_AARCH64, have, have_library, have_target,
};
use xtask::{aarch64, firmware};

/// Functions of a program that take roots, and halfwords of its code at each of which `is_root` may find an
/// instruction.
fn roots(program: &Path, is_root: fn([u16; 2]) -> bool) -> (Vec<String>, usize) {
    let bytes = std::fs::read(program).unwrap_or_else(|error| panic!("{program:?}: {error}"));
    let file = object::File::parse(&*bytes).expect("a program");
    let names = file
        .symbols()
        .filter_map(|symbol| symbol.name().ok().map(str::to_owned));
    let functions = names.filter(|name| name.contains("sqrt")).collect();
    let code = file
        .sections()
        .filter(|section| section.kind() == SectionKind::Text);
    let instructions = code.map(|section| {
        let code = section.data().expect("code");
        let halfwords: Vec<u16> = code
            .as_chunks()
            .0
            .iter()
            .map(|two| u16::from_le_bytes(*two))
            .collect();
        halfwords
            .array_windows()
            .filter(|two| is_root(**two))
            .count()
    });
    (functions, instructions.sum())
}

/// VSQRT.F32 (Armv7-M Architecture Reference Manual, encoding T1).
fn is_vsqrt([first, second]: [u16; 2]) -> bool {
    first & 0xffbf == 0xeeb1 && second & 0x0fd0 == 0x0ac0
}

/// FSQRT of a single number, or of four (Arm Architecture Reference Manual for A-profile, C7.2).
fn is_fsqrt([low, high]: [u16; 2]) -> bool {
    let word = u32::from(high) << 16 | u32::from(low);
    word & 0xffff_fc00 == 0x1e21_c000 || word & 0xffff_fc00 == 0x6ea1_f800
}

fn check_image(processor: &Processor) {
    let what = format!("the square root on {}", processor.name);
    let Some(toolchain) = have_target(processor.target, &what).filter(|_| have(&[ARM_GCC], &what))
    else {
        return;
    };
    let images = firmware::build(&toolchain, processor).unwrap_or_else(|error| panic!("{error}"));
    let (functions, instructions) = roots(&images.join("step-cost"), is_vsqrt);
    assert_eq!(functions, [""; 0], "{}: in software", processor.name);
    // Two stages of a step, at least once for one damper and once for a bank.
    assert!(instructions >= 4, "{}: {instructions}", processor.name);
}

#[test]
fn a_cortex_m7_takes_its_own_root() {
    check_image(&CORTEX_M7);
}

#[test]
fn a_cortex_m4f_takes_its_own_root() {
    check_image(&CORTEX_M4F);
}

#[test]
fn a_cortex_m33_takes_its_own_root() {
    check_image(&CORTEX_M33);
}

/// SQRTSS of one number or SQRTPS of four (Intel Software Developer's Manual, volume 2), at even places.
#[cfg(target_arch = "x86_64")]
fn is_sqrt(halfwords: [u16; 2]) -> bool {
    let bytes = halfwords.map(u16::to_le_bytes);
    bytes
        .as_flattened()
        .array_windows()
        .any(|two| *two == [0x0f, 0x51])
}

#[cfg(target_arch = "x86_64")]
#[test]
fn a_desktop_takes_its_own_root() {
    let folder = repository().join("target/experiment");
    let mut build = Command::new("cargo");
    build.args([
        "build",
        "--release",
        "--package",
        "dashpot-experiment",
        "--target-dir",
    ]);
    succeed(build.arg(&folder).current_dir(repository()));
    let (functions, instructions) = roots(&folder.join("release/dashpot-experiment"), is_sqrt);
    assert_eq!(functions, [""; 0], "in software");
    assert!(instructions >= 4, "{instructions}");
}

/// The bank takes another vector path there than on x86-64.
#[test]
fn a_64_bit_arm_takes_its_own_root_and_has_the_hosts_bits() {
    let what = "square root and force bits on a 64-bit Arm processor";
    if !have_library(AARCH64, what) || !have(&[AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64], what) {
        return;
    }
    succeed(aarch64::cargo("build").args(["--release", "--package", "dashpot-experiment"]));
    let program = aarch64::release("dashpot-experiment");
    let (functions, instructions) = roots(&program, is_fsqrt);
    assert_eq!(functions, [""; 0], "in software");
    assert!(instructions >= 4, "{instructions}");
    for experiment in experiments(0.1) {
        let found = experiment.digest_by(&mut aarch64::program(&program));
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        assert_eq!(found, experiment.digest_here(), "{element}, {excitation}");
    }
    // Both precisions against exact arithmetic.
    let mut tests = aarch64::cargo("test");
    tests.args([
        "--package",
        "dashpot-core",
        "--no-default-features",
        "--lib",
        "square_root",
    ]);
    let printed = succeed(&mut tests);
    assert!(printed.contains("3 passed"), "{printed}");
}

#[test]
fn a_target_that_leaves_the_processors_root_unused_says_so() {
    let warning = |target| {
        have_library(target, "the warning about a root in software").then_some(())?;
        let mut check = Command::new("cargo");
        check.args([
            "check",
            "--package",
            "dashpot-core",
            "--no-default-features",
        ]);
        check.args(["--target", target, "--target-dir", "target/soft_float"]);
        check.current_dir(repository()).env_remove("RUSTFLAGS");
        Some(succeed(&mut check).contains("takes square roots in software on"))
    };
    assert_ne!(warning(SOFT_FLOAT), Some(false), "a Cortex-M7 may have it");
    assert_ne!(warning(CORTEX_M3), Some(true), "no Cortex-M3 has it");
}

/// All that a command prints.
fn succeed(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = [output.stdout, output.stderr].concat();
    let printed = String::from_utf8_lossy(&printed).into_owned();
    assert!(
        output.status.success(),
        "{command:?}: {}\n{printed}",
        output.status
    );
    printed
}
